import {shows, text} from './scales.js';

// What stands under the mouse or, by the arrow keys, next: told beside the point and to screen readers.
const live = document.body.appendChild(document.createElement('div'));
live.className = 'sr';
live.setAttribute('aria-live', 'polite');

export const copied = async words => {
  try {
    await navigator.clipboard.writeText(words);
  } catch {  // no clipboard for this page: the old way
    const area = document.body.appendChild(document.createElement('textarea'));
    area.value = words;
    area.select();
    document.execCommand('copy');
    area.remove();
  }
  live.textContent = `Copied: ${words}`;
};

const interval = (low, high) => low == null || high == null ? '' : ` (${text(low)} to ${text(high)})`;

// Of a plot: what it tells, and what keys do.
export const telling = {
  lines(mark, i) {
    const {x, y} = this.picture, out = [];
    const value = (axis, v, low, high) => (axis.names ? axis.names[Math.round(v)] : text(v)) + interval(low, high) + (axis.unit && axis.unit !== '1' ? ` ${axis.unit}` : '');
    if (mark.name) out.push(mark.name);
    if (mark.labels?.[i] && mark.labels[i] !== mark.name) out.push(mark.labels[i]);
    if (!x.names || mark.kind === 'cells') out.push(`${x.label}: ${value(x, mark.x[i], mark.x_low?.[i], mark.x_high?.[i])}`);
    if (mark.from) out.push(`whiskers: ${text(mark.from[i])} to ${text(mark.to[i])}`);
    if (!y.names || mark.kind === 'cells') out.push(`${y.label}: ${value(y, mark.y[i], mark.y_low?.[i], mark.y_high?.[i])}`);
    if (this.picture.x.log && this.picture.y.log && mark.kind === 'line' && i > 0 && mark.y[i] > 0 && mark.y[i - 1] > 0)
      out.push(`slope: ${text(Math.log(mark.y[i] / mark.y[i - 1]) / Math.log(mark.x[i] / mark.x[i - 1]))}`);
    if (mark.addresses?.[i]) out.push(mark.addresses[i], 'click or Enter copies gyrostat replay');
    return out;
  },

  tell(mark, i) {
    this.told = {mark, i};
    const m = this.picture.marks[mark], u = this.u, left = u.valToPos(m.x[i], 'x') + u.over.offsetLeft, top = u.valToPos(m.y[i], 'y') + u.over.offsetTop;
    this.tip.replaceChildren(...this.lines(m, i).map((line, k) => Object.assign(document.createElement(k ? 'div' : 'b'), {textContent: line})));
    this.tip.hidden = false;
    const room = this.box.clientWidth - this.tip.offsetWidth - 4;
    this.tip.style.left = `${Math.max(0, Math.min(left + 12, room))}px`;
    this.tip.style.top = `${top - this.tip.offsetHeight - 10 < 0 ? top + 14 : top - this.tip.offsetHeight - 10}px`;
  },

  hover(u) {
    const {left, top} = u.cursor;
    if (left == null || left < 0) {
      this.tip.hidden = true;
      this.told = null;
      return;
    }
    let best = null, least = 45;
    this.picture.marks.forEach((mark, k) => {
      if (mark.shown === false) return;
      const rows = ['bars', 'boxes', 'cells'].includes(mark.kind);
      for (let i = 0; i < mark.x.length; ++i) {
        if (!shows(this.picture.x, mark.x[i]) || !shows(this.picture.y, mark.y[i])) continue;
        const dx = Math.abs(u.valToPos(mark.x[i], 'x') - left), dy = Math.abs(u.valToPos(mark.y[i], 'y') - top);
        const distance = rows && mark.kind !== 'cells' ? dy + Math.min(dx, 12) : Math.hypot(dx, dy) + (mark.name ? 0 : 10);
        if (distance < least) { least = distance; best = [k, i]; }
      }
    });
    if (best) this.tell(...best);
    else { this.tip.hidden = true; this.told = null; }
  },

  // Left and right go along a mark, up and down from one to the next.
  step(along, across) {
    const marks = this.picture.marks, seen = marks.map((_, k) => k).filter(k => marks[k].shown !== false && marks[k].x.some(v => v != null));
    if (!seen.length) return;
    let {mark, i} = this.told ?? {mark: seen[0], i: -1};
    if (across) {
      const x = marks[mark].x[Math.max(i, 0)];
      mark = seen[(seen.indexOf(mark) + across + seen.length) % seen.length];
      const away = v => v == null ? Infinity : Math.abs(v - x);
      i = marks[mark].x.reduce((best, v, k) => away(v) < away(marks[mark].x[best]) ? k : best, 0);
    } else {
      const n = marks[mark].x.length;
      for (let k = 0; k < n; ++k) {
        i = (i + along + n) % n;
        if (shows(this.picture.x, marks[mark].x[i]) && shows(this.picture.y, marks[mark].y[i])) break;
      }
    }
    this.tell(mark, i);
    live.textContent = this.lines(marks[mark], i).join(', ');
  },

  key(e) {
    if (e.target !== this.box || e.ctrlKey || e.metaKey || e.altKey) return;
    const pan = 0.15, does = {
      '+': () => this.zoom(1.4), '=': () => this.zoom(1.4), '-': () => this.zoom(1 / 1.4), '0': () => this.zoom(),
      Escape: () => { this.tip.hidden = true; this.told = null; this.zoom(); }, Enter: () => this.copy(),
      ArrowRight: () => e.shiftKey ? this.zoom(1, [pan, 0]) : this.step(1, 0), ArrowLeft: () => e.shiftKey ? this.zoom(1, [-pan, 0]) : this.step(-1, 0),
      ArrowDown: () => e.shiftKey ? this.zoom(1, [0, -pan]) : this.step(0, 1), ArrowUp: () => e.shiftKey ? this.zoom(1, [0, pan]) : this.step(0, -1),
    }[e.key];
    if (!does) return;
    e.preventDefault();
    does();
  },

  copy() {
    const address = this.told && this.picture.marks[this.told.mark].addresses?.[this.told.i];
    if (!address) return;
    copied(`gyrostat replay ${address}`);
    this.tip.append(Object.assign(document.createElement('div'), {textContent: 'copied', className: 'done'}));
  },
};
