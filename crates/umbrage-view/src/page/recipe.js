// A recipe's text, and its fields as controls.

export class Recipe {
  constructor(text) {
    const [name, ...rest] = text.split(",");
    this.name = name;
    this.values = new Map(rest.filter(Boolean).map((field) => {
      const at = field.indexOf("=");
      return [field.slice(0, at), field.slice(at + 1)];
    }));
  }

  text() {
    return [this.name, ...[...this.values].map(([name, value]) => `${name}=${value}`)].join(",");
  }
}

// An element with properties and children.
export function made(tag, properties = {}, ...children) {
  const element = Object.assign(document.createElement(tag), properties);
  element.append(...children);
  return element;
}

// A text whose words between backticks are code.
export function worded(text) {
  return text.split("`").map((part, index) => (index % 2 ? made("code", { textContent: part }) : part));
}

// The control of a field with its value, which is null where it has none. `changed` is given the new one.
function control(field, value, id, changed) {
  const { control: kind, default: own } = field;
  if (kind.type === "words") {
    const options = kind.words.map((word) => made("option", { value: word, textContent: word === own ? `${word} (default)` : word }));
    if (own === null) options.unshift(made("option", { value: "", textContent: "not set (default)" }));
    const select = made("select", { id }, ...options);
    select.value = value ?? own ?? "";
    select.addEventListener("change", () => changed(select.value));
    return select;
  }
  const input = made("input", { id, type: kind.type === "text" ? "text" : "number", placeholder: own ?? "not set", value: value ?? "" });
  if (kind.type !== "text") {
    input.step = kind.type === "whole" ? "1" : "any";
    input.min = kind.least;
    if (kind.most !== null && kind.most !== undefined) input.max = kind.most;
  }
  input.addEventListener("change", () => changed(input.value.trim()));
  return input;
}

// Fills an element with the controls of a recipe's fields. `changed` is called once a value of the recipe has changed.
export function showFields(place, preset, recipe, changed) {
  place.replaceChildren();
  const shown = new Set();
  for (const field of preset.fields) {
    // Two rows with one name are one field.
    if (shown.has(field.name)) continue;
    shown.add(field.name);
    const id = `field-${field.name}`;
    const row = made("div", { className: "row" });
    const mark = () => row.classList.toggle("changed", recipe.values.has(field.name));
    const input = control(field, recipe.values.get(field.name) ?? null, id, (value) => {
      if (value === "" || value === field.default) recipe.values.delete(field.name);
      else recipe.values.set(field.name, value);
      mark();
      changed();
    });
    input.setAttribute("aria-describedby", `${id}-about`);
    mark();
    row.append(made("label", { htmlFor: id, textContent: field.name }), input);
    const source = field.source ? ` (${field.source})` : "";
    const values = field.control.type === "words" ? "" : `${field.values}; `;
    place.append(row, made("p", { className: "about", id: `${id}-about` }, ...worded(`${values}${field.about}${source}`)));
  }
}
