// The page: its controls, its state, and what is shown of both.

import { State } from "./state.js";
import { Recipe, made, showFields, worded } from "./recipe.js";
import { Asking, ask } from "./asking.js";
import { Picture } from "./picture.js";

const by = (id) => document.getElementById(id);
const SIZES = [32, 64, 128, 256, 512, 1024, 2048, 4096];
const FAULTS = { acne: "orange", detachment: "cyan", leak: "magenta", "other false shadow": "brown", "other false light": "blue" };
const COLOURS = { "false-shadow": "orange", "false-light": "cyan", acne: "orange", detachment: "cyan", leak: "magenta" };

let about, state, recipe, picture, asking, truthKey = null;
const times = [];

function problem(error) {
  by("problem").textContent = error.message;
  by("problem").hidden = false;
  by("status").textContent = "";
}

// Degrees with one digit; azimuths above -180, at most 180.
const tenth = (degrees) => Math.round(degrees * 10) / 10;
const around = (degrees) => tenth(degrees - 360 * Math.ceil(degrees / 360 - 0.5));
const bounded = (degrees) => tenth(Math.min(90, Math.max(-90, degrees)));

// The light that is turned: the only one that shines, or the one that is chosen.
const turned = () => about.lights.find(({ name }) => name === (state.light ?? by("turned").value)) ?? about.lights[0];
const angles = (light) => state.turns.get(light.name) ?? [tenth(light.azimuth), tenth(light.elevation)];

function turnTo(azimuth, elevation, moving) {
  const light = turned();
  if (!light || !Number.isFinite(azimuth) || !Number.isFinite(elevation)) return;
  state.turns.set(light.name, [around(azimuth), bounded(elevation)]);
  changed(moving);
}

// Writes the state into the address, shows it in the controls, and requests its picture.
function changed(moving = false) {
  keep();
  controls();
  asking.change(moving);
}

function keep() {
  history.replaceState(null, "", `#${state.query()}`);
}

function fill(select, options, value) {
  select.replaceChildren(...options.map(([value, text]) => made("option", { value, textContent: text })));
  select.value = value;
}

function controls() {
  by("show").value = state.show;
  by("wiping").checked = state.wipe !== null;
  by("wiping").disabled = !state.mayWipe;
  by("wiper").hidden = state.wipe === null || !state.mayWipe;
  by("wipe").value = state.wipe ?? 0.5;
  by("light").value = state.light ?? "";
  const light = turned();
  by("turns").hidden = state.light !== null || about.lights.length < 2;
  if (light) {
    const at = angles(light);
    for (const [index, name] of ["azimuth", "elevation"].entries()) {
      by(name).value = at[index];
      if (document.activeElement !== by(`${name}-number`)) by(`${name}-number`).value = at[index];
    }
    by("back").disabled = state.turns.size === 0;
  }
  by("map-size").value = state.mapSize ?? about.mapSize;
  by("samples").value = state.samples ?? about.samples;
  by("why").hidden = state.pixel === null;
  picture.wipe = state.mayWipe && state.wipe !== null ? Number(state.wipe) : null;
  picture.pixel = state.at;
  if (truthKey !== state.truthKey) {
    picture.truth = null;
    truthKey = null;
  }
  tags();
  picture.draw();
}

function tags() {
  by("left").hidden = by("right").hidden = picture.wipe === null;
  by("left").textContent = "maps";
  by("right").textContent = picture.truth ? "rays" : "rays follow";
}

// The recipe's controls, made anew when the recipe changes.
function showRecipe() {
  recipe = new Recipe(state.recipe ?? "auto");
  const preset = about.recipes.find(({ name }) => name === recipe.name) ?? about.recipes[0];
  const own = state.recipe === null && about.ownRecipes;
  by("recipe").value = own ? "" : preset.name;
  by("about").replaceChildren(...worded(own ? "the recipe that each light's own tree names, or else auto" : preset.about));
  by("more").hidden = own;
  showFields(by("fields"), preset, recipe, () => {
    state.recipe = recipe.text();
    changed();
  });
}

// A picture of one light needs one to be chosen.
function chooseLight() {
  const needed = state.show === "shadow" || state.isJudged;
  if (needed && state.light === null && about.lights.length > 1) state.light = turned().name;
}

const shown = {
  problem,
  busy: (what) => { by("status").textContent = what; },
  truthKey: () => truthKey,
  result(image, told, draft) {
    by("problem").hidden = true;
    picture.result = image;
    picture.draw();
    const now = performance.now();
    times.push(now);
    while (times.length && now - times[0] > 1000) times.shift();
    const rate = asking.moving && times.length > 1 ? `, ${times.length} pictures per second` : "";
    const judged = told.judged === undefined ? "" : `, ${told.judged} pixels judged`;
    by("caption").textContent = `${told.size[0]} × ${told.size[1]}${draft ? ", 1 sample" : ""} in ${told.ms} ms${rate}${judged}${note(draft)}`;
    faults(draft ? [] : told.faults ?? []);
  },
  truth(image, told, draft, key) {
    if (key === null && truthKey === state.truthKey) return;
    picture.truth = image;
    truthKey = key;
    tags();
    picture.draw();
  },
  lines(lines) {
    by("lines").replaceChildren(...lines.flatMap(({ what, line }) => {
      const copy = made("button", { type: "button", textContent: "Copy" });
      copy.setAttribute("aria-label", `Copy the command line of ${what}`);
      copy.addEventListener("click", async () => {
        try {
          await navigator.clipboard.writeText(line);
          copy.textContent = "Copied";
        } catch {
          getSelection().selectAllChildren(code);
          copy.textContent = "Selected";
        }
        setTimeout(() => { copy.textContent = "Copy"; }, 1500);
      });
      const code = made("pre", { textContent: line });
      return [made("div", { className: "what" }, made("span", { textContent: what }), copy), code];
    }));
  },
  why({ pixel, lights }) {
    by("whose").textContent = `Pixel ${pixel.join(", ")}`;
    by("words").replaceChildren(...lights.flatMap(({ words, fault, svg }) => {
      const all = [made("pre", { textContent: words, tabIndex: 0 })];
      if (fault) all.unshift(made("p", {}, made("strong", { textContent: fault })));
      if (svg) {
        const drawn = new DOMParser().parseFromString(svg, "image/svg+xml").documentElement;
        all.push(made("div", { className: "drawn" }, document.importNode(drawn, true)));
      }
      return all;
    }));
  },
};

function note(draft) {
  if (state.show === "shadow" || (draft && state.isJudged)) return "; white is lit";
  if (state.show === "difference") return "; orange is too dark, blue too light";
  return "";
}

function faults(rows) {
  by("faults").hidden = rows.length === 0;
  const names = state.show === "faults" ? FAULTS : { [state.show.replace("-", " ")]: COLOURS[state.show] };
  by("faults").replaceChildren(...rows.map(([name, value]) => {
    const term = made("dt", { textContent: `${name} ` });
    if (names[name]) term.prepend(made("span", { className: `swatch ${names[name]}` }), " ");
    return made("div", {}, term, made("dd", { textContent: value ?? "none" }));
  }));
  if (rows.length && state.show === "faults") {
    for (const name of ["other false shadow", "other false light"]) {
      by("faults").append(made("div", {}, made("dt", {}, made("span", { className: `swatch ${FAULTS[name]}` }), ` ${name}`)));
    }
  }
}

const does = {
  turn(right, down, moving) {
    if (!moving) return asking.settle();
    const light = turned();
    if (!light) return;
    const [azimuth, elevation] = angles(light);
    // As if the side of a globe about the scene that is nearest to the viewer were moved.
    turnTo(azimuth - right, elevation - down, true);
  },
  explain([x, y]) {
    state.pixel = `${x},${y}`;
    keep();
    controls();
    by("words").textContent = "Explaining";
    by("whose").textContent = `Pixel ${x}, ${y}`;
    asking.beside();
  },
  at([x, y]) {
    by("status").textContent = `Column ${x}, row ${y}`;
  },
  wipe(share) {
    state.wipe = String(Math.round(share * 100) / 100);
    keep();
    controls();
  },
  close() {
    state.pixel = null;
    keep();
    controls();
    asking.beside();
  },
};

function listen() {
  const on = (id, event, then) => by(id).addEventListener(event, then);
  on("controls", "submit", (event) => event.preventDefault());
  on("show", "change", () => {
    state.show = by("show").value;
    chooseLight();
    changed();
  });
  on("wiping", "change", () => {
    state.wipe = by("wiping").checked ? "0.5" : null;
    keep();
    controls();
    asking.done.truth = undefined;
    asking.beside();
  });
  on("wipe", "input", () => does.wipe(Number(by("wipe").value)));
  on("light", "change", () => {
    state.light = by("light").value || null;
    chooseLight();
    changed();
  });
  on("turned", "change", controls);
  for (const name of ["azimuth", "elevation"]) {
    const read = (input) => {
      const at = angles(turned());
      at[name === "azimuth" ? 0 : 1] = Number(by(input).value);
      turnTo(...at, true);
    };
    on(name, "input", () => read(name));
    on(name, "change", () => asking.settle());
    on(`${name}-number`, "change", () => read(`${name}-number`));
  }
  on("back", "click", () => {
    state.turns.clear();
    changed();
  });
  on("recipe", "change", () => {
    state.recipe = by("recipe").value || null;
    showRecipe();
    changed();
  });
  on("plain", "click", () => {
    state.recipe = recipe.name;
    showRecipe();
    changed();
  });
  on("map-size", "change", () => {
    state.mapSize = by("map-size").value;
    changed();
  });
  on("samples", "change", () => {
    state.samples = by("samples").value;
    changed();
  });
  on("close", "click", () => {
    does.close();
    by("canvas").focus();
  });
  addEventListener("hashchange", () => {
    state = asking.state = new State(location.hash.slice(1));
    chooseLight();
    showRecipe();
    controls();
    asking.change();
  });
  addEventListener("resize", () => picture.draw());
}

async function start() {
  about = await (await ask("about")).json();
  document.title = `${about.scene} – Umbrage`;
  by("scene").textContent = about.scene;
  by("canvas").setAttribute("aria-label", `Picture of ${about.scene}, ${about.size[0]} by ${about.size[1]} pixels`);
  state = new State(location.hash.length > 1 ? location.hash.slice(1) : about.first);
  const named = about.lights.map(({ name, kind }) => [name, name === kind ? name : `${name} (${kind})`]);
  fill(by("light"), [["", named.length > 1 ? "all lights" : named[0]?.[1] ?? "no light casts shadows"], ...(named.length > 1 ? named : [])], "");
  fill(by("turned"), named, named[0]?.[0]);
  by("choice").hidden = named.length < 1;
  const own = about.ownRecipes ? [["", "each light's own"]] : [];
  fill(by("recipe"), [...own, ...about.recipes.map(({ name }) => [name, name])], "");
  const sizes = [...new Set([...SIZES, about.mapSize, Number(state.mapSize) || about.mapSize])].sort((a, b) => a - b);
  fill(by("map-size"), sizes.map((size) => [size, `${size} × ${size} texels`]), about.mapSize);
  fill(by("samples"), [1, 4, 16, 64].map((count) => [count, count === 1 ? "1 per pixel" : `${count} per pixel`]), about.samples);
  by("page").hidden = false;
  by("more").open = innerWidth >= 860;
  picture = new Picture(by("canvas"), about.size, does);
  asking = new Asking(state, shown);
  showRecipe();
  listen();
  chooseLight();
  changed();
}

start().catch(problem);
