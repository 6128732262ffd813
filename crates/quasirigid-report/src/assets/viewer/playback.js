// The clock of the picture: time in the run, speed over real time, and whether it plays.
class Clock {
  constructor(start, end, loops = false) {
    Object.assign(this, { start, end, loops, time: start, speed: 1, playing: false, step: 0 });
    this.last = null;
    this.kept = null;
  }

  /** Takes the place of another clock. Frames of an unfinished run end early: what they cut off comes back with the rest of them. */
  replace({ time, playing, speed, end, kept }) {
    this.kept = time === end && kept?.time >= end ? kept : { time, playing };
    this.time = clamp(this.kept.time, this.start, this.end);
    Object.assign(this, { playing: this.kept.playing, speed });
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
    if (this.kept) this.kept.playing = playing;
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
      if (!(this.kept?.time > this.end)) this.kept = { time: this.end, playing: true };
      this.time = this.end;
      this.playing = false;
    }
  }
}
