// What the page shows, in the words of its address's fragment, which are also those of requests.

export class State {
  constructor(query = "") {
    const words = new URLSearchParams(query);
    this.show = words.get("show") ?? "picture";
    this.recipe = words.get("recipe");
    this.mapSize = words.get("map-size");
    this.light = words.get("light");
    this.samples = words.get("samples");
    this.wipe = words.get("wipe");
    this.pixel = words.get("pixel");
    // Names may hold an equals sign, angles do not.
    this.turns = new Map(words.getAll("turn").map((turn) => {
      const at = turn.lastIndexOf("=");
      return [turn.slice(0, at), turn.slice(at + 1).split(",").map(Number)];
    }));
  }

  query() {
    const words = new URLSearchParams();
    if (this.show !== "picture") words.set("show", this.show);
    const all = { recipe: this.recipe, "map-size": this.mapSize, light: this.light, samples: this.samples, wipe: this.wipe, pixel: this.pixel };
    for (const [name, value] of Object.entries(all)) {
      if (value !== null && value !== undefined) words.set(name, value);
    }
    for (const [name, [azimuth, elevation]] of this.turns) words.append("turn", `${name}=${azimuth},${elevation}`);
    return words.toString();
  }

  // Whether it compares one light's shadow with truth.
  get isJudged() {
    return !["picture", "shadow", "truth"].includes(this.show);
  }

  // Whether two pictures may lie side by side.
  get mayWipe() {
    return this.show === "picture" || this.show === "shadow";
  }

  // What truth depends on: it is the same for every recipe.
  get truthKey() {
    const kind = this.show === "picture" || this.show === "truth" ? "lit" : "dark";
    return JSON.stringify([kind, this.light, [...this.turns], this.samples]);
  }

  // The pixel that is explained, as numbers.
  get at() {
    return this.pixel ? this.pixel.split(",").map(Number) : null;
  }
}
