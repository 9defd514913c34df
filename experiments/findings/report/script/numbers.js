import {head, text} from './scales.js';

// A picture's numbers, one row a point, as a table and as a file.
export const numbers = picture => {
  const value = (axis, v) => v == null ? '' : axis.names && Number.isInteger(v) ? axis.names[v] : v;
  const columns = [['series', m => i => m.name]];
  const has = key => picture.marks.some(m => m[key]?.length);
  for (const [key, which] of [['x', 'x'], ['x_low', 'x'], ['x_high', 'x'], ['from', 'x'], ['to', 'x'], ['y', 'y'], ['y_low', 'y'], ['y_high', 'y']])
    if (has(key)) columns.push([(key.length === 1 ? '' : {x_low: 'low ', y_low: 'low ', x_high: 'high ', y_high: 'high ', from: 'whisker from ', to: 'whisker to '}[key]) +
      (head(picture[which]) || which), m => i => value(picture[which], m[key]?.[i])]);
  if (has('labels')) columns.push(['label', m => i => m.labels?.[i] ?? '']);
  if (has('addresses')) columns.push(['replay', m => i => m.addresses?.[i] ?? '']);
  const rows = picture.marks.flatMap(m => { const cells = columns.map(([, of]) => of(m)); return m.x.map((_, i) => cells.map(c => c(i))); });
  return {heads: columns.map(([name]) => name), rows};
};

export const csv = ({heads, rows}) => [heads, ...rows].map(row => row.map(v => /[",\n]/.test(v) ? `"${String(v).replaceAll('"', '""')}"` : v).join(',')).join('\n') + '\n';

export const save = (name, words) => {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob([words], {type: 'text/csv'}));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
};

export const table = ({heads, rows}) => {
  const box = document.createElement('div'), out = box.appendChild(document.createElement('table'));
  box.className = 'scroll numbers';
  box.tabIndex = 0;
  const add = (part, cells, tag) => {
    const row = part.insertRow();
    for (const c of cells) row.append(Object.assign(document.createElement(tag), {textContent: typeof c === 'number' ? text(c) : c}));
  };
  add(out.createTHead(), heads, 'th');
  const body = out.createTBody();
  rows.slice(0, 400).forEach(row => add(body, row, 'td'));
  if (rows.length > 400) add(body, [`… ${rows.length - 400} more rows in the CSV`], 'td');
  return box;
};
