// The picture: truth beside it under a divider, the pixel that is explained, and what a pointer and keys do in it.

const THICK = 14; // How near to the divider a pointer grabs it, CSS pixels.
const CLICK = 4; // A pointer that moves less has clicked, CSS pixels.

export class Picture {
  // `does` has what pointers and keys do: `turn(right, down, moving)` in degrees, `explain([x, y])`, `wipe(share)`, `close()`.
  constructor(canvas, size, does) {
    Object.assign(this, { canvas, does, size, result: null, truth: null, wipe: null, pixel: null, cursor: null });
    [canvas.width, canvas.height] = size;
    this.pen = canvas.getContext("2d");
    canvas.addEventListener("pointerdown", (event) => this.down(event));
    canvas.addEventListener("pointermove", (event) => this.move(event));
    for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, (event) => this.up(event));
    canvas.addEventListener("keydown", (event) => this.key(event));
    canvas.addEventListener("blur", () => { this.cursor = null; this.draw(); });
  }

  draw() {
    const { pen, size: [width, height] } = this;
    pen.imageSmoothingEnabled = false;
    const put = (image, from, to) => {
      if (!image || to <= from) return;
      pen.save();
      pen.beginPath();
      pen.rect(from, 0, to - from, height);
      pen.clip();
      pen.drawImage(image, 0, 0, width, height);
      pen.restore();
    };
    const at = this.wipe === null ? width : this.wipe * width;
    put(this.result, 0, width);
    if (this.truth) put(this.truth, at, width);
    // Equally wide on the screen whatever the size of the picture.
    const unit = width / Math.max(1, this.canvas.clientWidth);
    if (this.wipe !== null) {
      this.line(at, 0, at, height, 3 * unit, "#000");
      this.line(at, 0, at, height, 1.5 * unit, "#fff");
    }
    for (const [place, colour] of [[this.pixel, "#ffd83d"], [this.cursor, "#fff"]]) {
      if (!place) continue;
      const [x, y] = [place[0] + 0.5, place[1] + 0.5];
      const [near, far] = [2 + 2 * unit, 2 + 9 * unit];
      for (const [across, down] of [[1, 0], [-1, 0], [0, 1], [0, -1]]) {
        const ends = [x + across * near, y + down * near, x + across * far, y + down * far];
        this.line(...ends, 4 * unit, "#000");
        this.line(...ends, 2 * unit, colour);
      }
    }
  }

  line(x, y, toX, toY, wide, colour) {
    Object.assign(this.pen, { lineWidth: wide, strokeStyle: colour });
    this.pen.beginPath();
    this.pen.moveTo(x, y);
    this.pen.lineTo(toX, toY);
    this.pen.stroke();
  }

  // A pointer's place: CSS pixels from the left, the fraction of the width, and the pixel.
  place(event) {
    const box = this.canvas.getBoundingClientRect();
    const share = [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height];
    const pixel = share.map((share, axis) => Math.min(this.size[axis] - 1, Math.max(0, Math.floor(share * this.size[axis]))));
    return { left: event.clientX - box.left, width: box.width, share: Math.min(1, Math.max(0, share[0])), pixel };
  }

  isAtLine(place) {
    return this.wipe !== null && Math.abs(place.left - this.wipe * place.width) <= THICK;
  }

  down(event) {
    if (event.button !== 0) return;
    this.canvas.setPointerCapture(event.pointerId);
    this.held = { id: event.pointerId, from: [event.clientX, event.clientY], last: [event.clientX, event.clientY], wipes: this.isAtLine(this.place(event)), moved: false };
  }

  move(event) {
    const place = this.place(event);
    const { held } = this;
    if (!held || held.id !== event.pointerId) {
      this.canvas.style.cursor = this.isAtLine(place) ? "ew-resize" : "";
      return;
    }
    if (held.wipes) return this.does.wipe(place.share);
    held.moved ||= Math.hypot(event.clientX - held.from[0], event.clientY - held.from[1]) >= CLICK;
    if (!held.moved) return;
    const by = [event.clientX - held.last[0], event.clientY - held.last[1]];
    held.last = [event.clientX, event.clientY];
    if (by[0] || by[1]) this.does.turn(by[0] * 0.5, by[1] * 0.4, true);
  }

  up(event) {
    const { held } = this;
    if (!held || held.id !== event.pointerId) return;
    this.held = null;
    if (held.moved) this.does.turn(0, 0, false);
    else if (!held.wipes && event.type === "pointerup") this.does.explain(this.place(event).pixel);
  }

  key(event) {
    const way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    if (way && event.shiftKey) {
      this.does.turn(2 * way[0], 2 * way[1], true);
    } else if (way) {
      const step = event.ctrlKey ? 10 : 1;
      const from = this.cursor ?? this.pixel ?? this.size.map((size) => Math.floor(size / 2));
      this.cursor = from.map((at, axis) => Math.min(this.size[axis] - 1, Math.max(0, at + step * way[axis])));
      this.does.at(this.cursor);
      this.draw();
    } else if (event.key === "Enter" || event.key === " ") {
      this.does.explain(this.cursor ?? this.pixel ?? this.size.map((size) => Math.floor(size / 2)));
    } else if (event.key === "Escape") {
      this.does.close();
    } else {
      return;
    }
    event.preventDefault();
  }
}
