// Requests what the page shows: a small picture first, then the whole one, then truth, and nothing that is out of date.

export class Gone extends Error {}
export class Refused extends Error {}
class Busy extends Error {}

// A request to this page's own server. Its errors: `Refused` with the line that explains why, `Gone` where the server does not answer.
export async function ask(path, signal) {
  let reply;
  try {
    reply = await fetch(path, { signal, cache: "no-store" });
  } catch (error) {
    if (signal?.aborted) throw error;
    throw new Gone("The command has ended: start it again and open the address that it prints.");
  }
  if (reply.status === 503) throw new Busy();
  if (!reply.ok) throw new Refused((await reply.text()).trim());
  return reply;
}

const pause = (ms) => new Promise((resolve) => setTimeout(resolve, ms));

// Requests pictures of a state that changes. The functions of `shown` are called with what arrives.
export class Asking {
  constructor(state, shown) {
    this.state = state;
    this.shown = shown;
    // Each change has its number; what belongs to an older one is no longer requested.
    this.generation = 0;
    this.moving = false;
    this.running = false;
    this.done = {};
  }

  // Called when the state has changed; `moving` while it is likely to change again at once.
  change(moving = false) {
    this.generation += 1;
    this.moving = moving;
    this.slow?.abort();
    clearTimeout(this.rest);
    if (moving) this.rest = setTimeout(() => this.settle(), 250);
    this.run();
  }

  // Called when nothing moves any more.
  settle() {
    clearTimeout(this.rest);
    this.moving = false;
    this.run();
  }

  // Called when only something beside the picture has changed: nothing is drawn again.
  beside() {
    this.done.lines = this.done.why = undefined;
    this.slow?.abort();
    this.run();
  }

  async run() {
    if (this.running) return;
    this.running = true;
    try {
      for (let step = this.next(); step; step = this.next()) {
        const generation = this.generation;
        // A small picture is worth showing even if the light has moved on meanwhile.
        this.slow = step.name === "draft" ? undefined : new AbortController();
        try {
          await step.work(this.slow?.signal, generation);
          this.done[step.name] = generation;
        } catch (error) {
          if (error instanceof Busy) {
            // Another tab moves its light.
            await pause(500);
          } else if (error.name !== "AbortError") {
            this.done[step.name] = generation;
            this.shown.problem(error);
            if (error instanceof Gone) return;
            // What follows would be refused as well.
            if (error instanceof Refused) for (const name of ["draft", "lines", "picture", "truth", "why"]) this.done[name] = generation;
          }
        }
      }
      this.shown.busy("");
    } finally {
      this.running = false;
    }
  }

  // The first step that is not done for the state as it is now.
  next() {
    const { state, shown } = this;
    const steps = [
      { name: "draft", work: (signal) => this.picture("draft=1", signal, shown.result, "") },
      { name: "lines", work: async (signal) => shown.lines((await (await ask(`lines?${state.query()}`, signal)).json()).lines) },
      { name: "picture", work: (signal) => this.picture("", signal, shown.result, state.isJudged ? "Judging by rays" : "Drawing") },
    ];
    if (state.pixel) {
      steps.push({ name: "why", work: async (signal) => {
        shown.busy("Explaining");
        shown.why(await (await ask(`explanation?${state.query()}`, signal)).json());
      } });
    }
    if (state.mayWipe && state.wipe !== null) {
      const key = state.truthKey;
      steps.push({ name: "truth", work: async (signal) => {
        if (shown.truthKey() === key) return;
        await this.picture("of=truth&draft=1", signal, (...came) => shown.truth(...came, null), "Tracing rays");
        await this.picture("of=truth", signal, (...came) => shown.truth(...came, key), "Tracing rays");
      } });
    }
    const due = steps.filter(({ name }) => this.done[name] !== this.generation);
    return this.moving ? due.find(({ name }) => name === "draft") : due[0];
  }

  async picture(how, signal, came, busy) {
    this.shown.busy(busy);
    const draft = how.includes("draft");
    const reply = await ask(`picture?${this.state.query()}&${how}`, signal);
    const about = JSON.parse(reply.headers.get("umbrage-about") ?? "{}");
    const image = await createImageBitmap(await reply.blob());
    came(image, about, draft);
  }
}
