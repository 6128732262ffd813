// The clock of the picture: time in the run, speed over real time, and whether it plays.
class Clock {
  constructor(start, end, loops = false) {
    Object.assign(this, { start, end, loops, time: start, speed: 1, playing: false, step: 0 });
    this.last = null;
  }

  get part() {
    return this.end > this.start ? (this.time - this.start) / (this.end - this.start) : 0;
  }

  set part(part) {
    this.time = this.start + clamp(part, 0, 1) * (this.end - this.start);
  }

  play(playing) {
    if (playing && !this.loops && this.time >= this.end) this.time = this.start;
    this.playing = playing;
    this.last = null;
  }

  /** Goes on to a moment of real time, in milliseconds; a long pause, as of a hidden page, is not made up for. */
  tick(now) {
    const passed = this.last === null ? 0 : Math.min(now - this.last, 100) / 1000;
    this.last = now;
    this.step = this.playing ? passed * this.speed : 0;
    if (!this.playing) return;
    this.time += this.step;
    if (this.time < this.end) return;
    if (this.loops) this.time = this.start + ((this.time - this.start) % (this.end - this.start));
    else {
      this.time = this.end;
      this.playing = false;
    }
  }
}
