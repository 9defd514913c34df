import {colour, shows} from './scales.js';

// One drawer a kind of mark. `at` turns numbers into pixels of the canvas; `px` is one pixel of the page.
const drawLine = (c, picture, mark, at, px) => {
  const n = mark.x.length, seen = i => shows(picture.x, mark.x[i]) && shows(picture.y, mark.y[i]);
  if (mark.y_low) {
    c.beginPath();
    const inside = [...Array(n).keys()].filter(i => seen(i) && shows(picture.y, mark.y_low[i]) && shows(picture.y, mark.y_high[i]));
    for (const i of inside) c.lineTo(at.x(mark.x[i]), at.y(mark.y_high[i]));
    for (const i of inside.reverse()) c.lineTo(at.x(mark.x[i]), at.y(mark.y_low[i]));
    c.globalAlpha = 0.18;
    c.fill();
    c.globalAlpha = 1;
  }
  c.beginPath();
  c.lineWidth = (mark.strong ? 4 : 1.8) * px;
  c.setLineDash(mark.dashed ? [6 * px, 4 * px] : []);
  for (let i = 0, open = false; i < n; open = seen(i++)) {
    if (!seen(i)) continue;
    const x = at.x(mark.x[i]), y = at.y(mark.y[i]);
    if (open && mark.stepped) c.lineTo(x, at.y(mark.y[i - 1]));
    open ? c.lineTo(x, y) : c.moveTo(x, y);
  }
  c.stroke();
  c.setLineDash([]);
};

const drawWhiskers = (c, picture, mark, i, at, px) => {
  const x = at.x(mark.x[i]), y = at.y(mark.y[i]);
  c.beginPath();
  c.lineWidth = 1.2 * px;
  const across = (low, high) => {
    if (!shows(picture.x, low) || !shows(picture.x, high)) return;
    c.moveTo(at.x(low), y);
    c.lineTo(at.x(high), y);
  };
  if (mark.kind !== 'boxes') across(mark.x_low?.[i], mark.x_high?.[i]);
  across(mark.from?.[i], mark.to?.[i]);
  if (shows(picture.y, mark.y_low?.[i]) && shows(picture.y, mark.y_high?.[i])) {
    c.moveTo(x, at.y(mark.y_low[i]));
    c.lineTo(x, at.y(mark.y_high[i]));
  }
  c.stroke();
};

const isDark = fill => {
  const [r, g, b] = fill.match(/\d+(\.\d+)?/g).map(Number);
  return 0.3 * r + 0.59 * g + 0.11 * b < 140;
};
export const rgb = hex => hex[0] === '#' ? `rgb(${[1, 3, 5].map(k => parseInt(hex.slice(k, k + 2), 16))})` : hex;

const drawPoint = (c, picture, mark, i, at, px, labels) => {
  const x = at.x(mark.x[i]), y = at.y(mark.y[i]), row = at.row;
  if (mark.kind === 'cells') {
    const fill = rgb(colour(mark.fills[i])), w = at.column, name = mark.labels?.[i] ?? '';
    c.fillStyle = fill;
    c.fillRect(x - w / 2 + px / 2, y - row / 2 + px / 2, w - px, row - px);
    if (mark.strong) c.font = `bold ${c.font}`;
    if (c.measureText(name).width > w - 4 * px) return;
    c.fillStyle = isDark(fill) ? '#fff' : '#111';
    c.textAlign = 'center';
    c.fillText(name, x, y + 4 * px);
    return;
  }
  if (mark.kind === 'bars') {
    c.globalAlpha = 0.75;
    const zero = at.x(mark.from?.[i] ?? 0);
    c.fillRect(Math.min(x, zero), y - 0.36 * row, Math.abs(x - zero), 0.72 * row);
    c.globalAlpha = 1;
    c.strokeStyle = colour('ink');
    if (mark.labelled && mark.labels?.[i]) {
      c.fillStyle = colour('ink');
      c.textAlign = 'left';
      c.fillText(mark.labels[i], Math.max(x, zero) + 5 * px, y + 4 * px);
    }
  }
  drawWhiskers(c, picture, mark, i, at, px);
  if (mark.kind === 'boxes') {
    const low = at.x(mark.x_low[i]), high = at.x(mark.x_high[i]), half = 0.32 * row;
    c.fillStyle = colour('paper');
    c.fillRect(low, y - half, high - low, 2 * half);
    c.lineWidth = 1.2 * px;
    c.strokeRect(low, y - half, high - low, 2 * half);
    c.lineWidth = 3 * px;
    c.beginPath();
    c.moveTo(x, y - half);
    c.lineTo(x, y + half);
    c.stroke();
  }
  if (mark.kind !== 'points') return;
  c.beginPath();
  c.arc(x, y, (mark.labelled ? 4.5 : 3.5) * px, 0, 7);
  c.fillStyle = mark.dashed ? colour('paper') : colour(mark.colour);
  c.fill();
  c.lineWidth = 1.5 * px;
  c.stroke();
  if (mark.labelled && mark.labels?.[i])
    labels.push({x, y, name: mark.labels[i], reach: [mark.x_low, mark.x_high].map(v => shows(picture.x, v?.[i]) ? at.x(v[i]) : x)});
};

// Labels go where they hit neither each other nor the rim; one that finds no place is told on hovering only.
export const drawLabels = (c, labels, box, px) => {
  const taken = labels.map(({x, y, reach}) => [Math.min(x - 5 * px, reach[0]), y - 4 * px, Math.max(x + 5 * px, reach[1]), y + 4 * px]);
  c.fillStyle = colour('ink');
  c.textAlign = 'left';
  for (const {x, y, name} of labels) {
    const w = c.measureText(name).width, h = 13 * px;
    const spots = [[x + 7 * px, y - h / 2], [x - 7 * px - w, y - h / 2], [x + 6 * px, y - 18 * px], [x - 6 * px - w, y - 18 * px],
                   [x - w / 2, y - 20 * px], [x - w / 2, y + 7 * px], [x + 6 * px, y + 6 * px], [x - 6 * px - w, y + 6 * px]];
    const spot = spots.find(([a, b]) => a >= box.left && a + w <= box.left + box.width && b >= box.top && b + h <= box.top + box.height &&
      !taken.some(t => a < t[2] && t[0] < a + w && b < t[3] && t[1] < b + h));
    if (!spot) continue;
    taken.push([spot[0], spot[1], spot[0] + w, spot[1] + h]);
    c.fillText(name, spot[0], spot[1] + 10 * px);
  }
};

export const drawMark = (u, picture, mark) => {
  const c = u.ctx, px = uPlot.pxRatio, at = {x: v => u.valToPos(v, 'x', true), y: v => u.valToPos(v, 'y', true)};
  at.row = Math.abs(at.y(1) - at.y(0));
  at.column = Math.abs(at.x(1) - at.x(0));
  c.save();
  c.beginPath();
  c.rect(u.bbox.left, u.bbox.top, u.bbox.width, u.bbox.height);
  c.clip();
  c.strokeStyle = c.fillStyle = colour(mark.colour);
  c.font = `${11.5 * px}px system-ui, sans-serif`;
  if (mark.kind === 'line') drawLine(c, picture, mark, at, px);
  else for (let i = 0; i < mark.x.length; ++i) {
    if (!shows(picture.x, mark.x[i]) || !shows(picture.y, mark.y[i])) continue;
    c.strokeStyle = c.fillStyle = colour(mark.colour);
    drawPoint(c, picture, mark, i, at, px, u.labels);
  }
  c.restore();
};
