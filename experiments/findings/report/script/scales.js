// Colours are custom properties of the page's style, which follow the theme.
const probe = document.body.appendChild(document.createElement('span'));
probe.hidden = true;
export const colour = name => {
  if (name[0] === '#') return name;
  probe.style.color = `var(--${name})`;
  return getComputedStyle(probe).color;
};

export const text = v => v == null ? '–' : Number(v.toPrecision(4)).toString().replace('-', '−');
export const head = axis => axis.unit ? `${axis.label} [${axis.unit}]` : axis.label;

// Steps of 1, 2 or 5; on a logarithmic axis of more than a decade the decades, with 2 and 5 where there is room.
const linearTicks = (from, to, most) => {
  const raw = (to - from) / Math.max(most, 1), decade = 10 ** Math.floor(Math.log10(raw));
  const part = raw / decade, step = decade * (part < 1.5 ? 1 : part < 3.5 ? 2 : part < 7.5 ? 5 : 10);
  const all = [];
  for (let k = Math.ceil(from / step); k * step <= to; ++k) all.push(Number((k * step).toPrecision(12)));
  return all;
};
export const ticks = (axis, from, to, most) => {
  if (axis.names) return axis.names.map((_, i) => i).filter(i => i >= Math.min(from, to) && i <= Math.max(from, to));
  const span = axis.log ? Math.log10(to / from) : 0;
  if (!axis.log || span < 1) return linearTicks(from, to, most);
  const room = 1.4 * most / span, within = room >= 3 ? [1, 2, 5] : room >= 2 ? [1, 3] : [1], every = Math.ceil(span / Math.max(most, 2));
  const all = [];
  for (let e = Math.floor(Math.log10(from)); e <= Math.log10(to); ++e)
    if (e % every === 0) for (const k of within) if (k * 10 ** e >= from && k * 10 ** e <= to) all.push(Number((k * 10 ** e).toPrecision(6)));
  return all;
};
export const label = (axis, v) => {
  if (axis.names) return axis.names[v] ?? '';
  const size = Math.abs(v);
  if (v === 0 || (size >= 1e-3 && size < 1e5)) return text(v);
  const e = Math.floor(Math.log10(size) + 1e-9), digits = Number((v / 10 ** e).toPrecision(4));
  const power = String(e).replace(/./g, c => '⁰¹²³⁴⁵⁶⁷⁸⁹'[c] ?? '⁻');
  return `${digits === 1 ? '' : digits === -1 ? '−' : text(digits) + '·'}10${power}`;
};

// Whether a number has a place on the axis.
export const shows = (axis, v) => v != null && (!axis.log || v > 0);

// What the shown marks reach, with a rim, and with room for the labels of bars.
export const extent = (picture, which) => {
  const axis = picture[which];
  if (axis.names) return [-0.5, axis.names.length - 0.5];
  const keys = which === 'x' ? ['x', 'x_low', 'x_high', 'from', 'to'] : ['y', 'y_low', 'y_high'];
  let low = Infinity, high = -Infinity;
  const take = v => { if (shows(axis, v)) { low = Math.min(low, v); high = Math.max(high, v); } };
  for (const mark of picture.marks) {
    if (mark.shown === false) continue;
    for (const key of keys) (mark[key] ?? []).forEach(take);
    if (mark.kind === 'bars' && which === 'x') take(0);
  }
  if (low > high) return axis.log ? [1, 10] : [0, 1];
  if (axis.log) {
    const rim = low === high ? 1.3 : (high / low) ** 0.03;
    return [low / rim, high * rim];
  }
  const rim = low === high ? 0.5 * Math.abs(low) || 0.5 : 0.03 * (high - low);
  const labels = which === 'x' && picture.marks.some(m => m.kind === 'bars' && m.labelled) ? 0.12 * (high - low) : 0;
  return [low - rim, high + rim + labels];
};
