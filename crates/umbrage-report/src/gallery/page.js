"use strict";
const all = (selector, within = document) => [...within.querySelectorAll(selector)];
const byId = (id) => document.getElementById(id);
const clamp = (value, low, high) => Math.min(Math.max(value, low), high);

// Theme: as the system, light, dark. A browser that refuses storage to files keeps the choice as long as the page.
{
  const button = byId("theme");
  const names = { "": "Auto", light: "Light", dark: "Dark" };
  const order = Object.keys(names);
  const set = (name) => {
    document.documentElement.dataset.theme = name;
    button.textContent = names[name];
    button.setAttribute("aria-label", `Theme: ${names[name]}`);
  };
  let kept = "";
  try { kept = localStorage.getItem("umbrage-theme") || ""; } catch { /* none is kept */ }
  set(kept in names ? kept : "");
  button.addEventListener("click", () => {
    const next = order[(order.indexOf(document.documentElement.dataset.theme) + 1) % order.length];
    set(next);
    try { localStorage.setItem("umbrage-theme", next); } catch { /* not kept */ }
  });
}

// The list of figures follows the reading.
{
  const links = new Map(all("#nav .group a").map((link) => [link.hash.slice(1), link]));
  const strip = document.querySelector("#nav .groups");
  const column = byId("nav");
  let here = null;
  const mark = (link) => {
    if (link === here) return;
    here?.classList.remove("here");
    here?.removeAttribute("aria-current");
    here = link;
    here.classList.add("here");
    here.setAttribute("aria-current", "true");
    const [at, box] = [here.getBoundingClientRect(), strip.getBoundingClientRect()];
    strip.scrollLeft += at.left + at.width / 2 - box.left - box.width / 2;
    const view = column.getBoundingClientRect();
    if (at.top < view.top || at.bottom > view.bottom) column.scrollTop += at.top - view.top - view.height / 2;
  };
  const watcher = new IntersectionObserver((entries) => {
    for (const entry of entries) if (entry.isIntersecting && links.has(entry.target.id)) mark(links.get(entry.target.id));
  }, { rootMargin: "-20% 0px -79% 0px" });
  all("article").forEach((article) => watcher.observe(article));
}

// Wipes: the range input carries pointer, touch and keyboard alike.
for (const wipe of all(".wipe")) {
  const [stage, under, over] = [".stage", ".under", ".over"].map((part) => wipe.querySelector(part));
  const input = wipe.querySelector("input");
  const sides = all(".sides span", wipe);
  const cut = () => stage.style.setProperty("--cut", `${input.value}%`);
  const enlarged = () => stage.classList.toggle("enlarged", stage.clientWidth > under.naturalWidth);
  input.addEventListener("input", cut);
  under.addEventListener("load", enlarged);
  for (const tab of all(".tabs button", wipe)) {
    tab.addEventListener("click", () => {
      all(".tabs button", wipe).forEach((other) => other.setAttribute("aria-pressed", String(other === tab)));
      stage.style.cssText = tab.dataset.style;
      [under.src, over.src] = [tab.dataset.result, tab.dataset.truth];
      [under.alt, over.alt] = [tab.textContent, tab.dataset.other];
      [sides[0].textContent, sides[1].textContent] = [tab.textContent, tab.dataset.other];
      cut();
    });
  }
  cut();
  enlarged();
}

// The lightbox: whole pixels, never blended. Going to the next picture of the same size keeps the place, for blinking.
{
  const [box, table, picture] = [byId("lightbox"), byId("table"), byId("picture")];
  const levels = [1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48];
  let [links, index] = [[], 0];
  let view = { scale: 1, x: 0, y: 0 };
  let shown = "";

  const place = () => {
    const [width, height] = [picture.naturalWidth * view.scale, picture.naturalHeight * view.scale];
    const margin = 48;
    view.x = clamp(view.x, margin - width, table.clientWidth - margin);
    view.y = clamp(view.y, margin - height, table.clientHeight - margin);
    picture.style.transform = `translate(${Math.round(view.x)}px, ${Math.round(view.y)}px) scale(${view.scale})`;
    picture.classList.toggle("whole", view.scale >= 1);
    byId("level").textContent = `${+view.scale.toFixed(2)} ×`;
  };
  const fit = () => {
    const [width, height] = [picture.naturalWidth, picture.naturalHeight];
    const scale = Math.min(table.clientWidth / width, table.clientHeight / height);
    view.scale = scale >= 1 ? Math.floor(scale) : scale;
    view.x = (table.clientWidth - width * view.scale) / 2;
    view.y = (table.clientHeight - height * view.scale) / 2;
    place();
  };
  const zoom = (larger, at = { x: table.clientWidth / 2, y: table.clientHeight / 2 }) => {
    const next = larger ? levels.find((level) => level > view.scale) : levels.findLast((level) => level < view.scale);
    if (!next) return larger ? undefined : fit();
    view.x = at.x - (at.x - view.x) * next / view.scale;
    view.y = at.y - (at.y - view.y) * next / view.scale;
    view.scale = next;
    place();
  };
  const show = (step) => {
    index = (index + step + links.length) % links.length;
    const link = links[index];
    byId("caption").textContent = `${link.closest("article").id}: ${link.dataset.caption}`;
    byId("where").textContent = "";
    picture.alt = link.dataset.caption;
    picture.src = link.getAttribute("href");
  };
  picture.addEventListener("load", () => {
    const size = `${picture.naturalWidth} × ${picture.naturalHeight}`;
    if (size === shown) place(); else fit();
    shown = size;
  });
  const deeds = {
    previous: () => show(-1), next: () => show(1), in: () => zoom(true), out: () => zoom(false), fit, close: () => box.close(),
  };
  const pan = (x, y) => { view.x += x; view.y += y; place(); };
  const keys = {
    "+": deeds.in, "=": deeds.in, "-": deeds.out, "0": fit, PageUp: deeds.previous, PageDown: deeds.next,
    ArrowLeft: () => pan(60, 0), ArrowRight: () => pan(-60, 0), ArrowUp: () => pan(0, 60), ArrowDown: () => pan(0, -60),
  };
  box.addEventListener("keydown", (event) => {
    if (!keys[event.key] || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    keys[event.key]();
  });
  all("[data-do]", box).forEach((button) => button.addEventListener("click", deeds[button.dataset.do]));
  const pointer = (event) => {
    const edge = table.getBoundingClientRect();
    return { x: event.clientX - edge.left, y: event.clientY - edge.top };
  };
  table.addEventListener("wheel", (event) => { event.preventDefault(); zoom(event.deltaY < 0, pointer(event)); }, { passive: false });
  table.addEventListener("pointerdown", (event) => table.setPointerCapture(event.pointerId));
  table.addEventListener("pointermove", (event) => {
    if (event.buttons & 1) pan(event.movementX, event.movementY);
    const at = pointer(event);
    const each = view.scale * Number(links[index]?.dataset.zoom || 1);
    const [column, row] = [Math.floor((at.x - view.x) / each), Math.floor((at.y - view.y) / each)];
    const inside = at.x >= view.x && at.y >= view.y && at.x < view.x + picture.naturalWidth * view.scale && at.y < view.y + picture.naturalHeight * view.scale;
    byId("where").textContent = inside ? `pixel ${column}, ${row}` : "";
  });
  table.addEventListener("dblclick", (event) => zoom(true, pointer(event)));
  addEventListener("resize", () => { if (box.open) place(); });
  for (const link of all("a.open")) {
    link.addEventListener("click", (event) => {
      if (event.ctrlKey || event.metaKey || event.shiftKey) return;
      event.preventDefault();
      links = all("a.open", link.closest("article"));
      [index, shown] = [links.indexOf(link), ""];
      box.showModal();
      table.focus();
      show(0);
      if (picture.complete && picture.naturalWidth) fit();
    });
  }
}
