import {copied} from './telling.js';
import {Plot} from './plot.js';
import {csv, numbers, save, table} from './numbers.js';

const button = (words, title, does) => {
  const b = Object.assign(document.createElement('button'), {type: 'button', textContent: words, title});
  b.setAttribute('aria-label', title);
  b.addEventListener('click', does);
  return b;
};

export const plots = new Map();

const make = figure => {
  if (plots.has(figure)) return;
  const picture = JSON.parse(figure.querySelector('script').textContent), plot = new Plot(figure, picture);
  plots.set(figure, plot);
  const tools = figure.insertBefore(document.createElement('div'), figure.querySelector('.note'));
  tools.className = 'tools';
  const title = picture.title.toLowerCase();
  let shown = null;
  const wide = !picture.x.names || !picture.y.names;
  if (wide) tools.append(button('+', `Zoom in: ${title}`, () => plot.zoom(1.4)), button('−', `Zoom out: ${title}`, () => plot.zoom(1 / 1.4)),
                         button('Reset', `See all: ${title}`, () => plot.zoom()));
  const numbersButton = button('Numbers', `Numbers of: ${title}`, () => {
    shown = shown ? (shown.remove(), null) : figure.appendChild(table(numbers(picture)));
    numbersButton.setAttribute('aria-expanded', String(!!shown));
  });
  numbersButton.setAttribute('aria-expanded', 'false');
  tools.append(numbersButton, button('CSV', `Download the numbers of: ${title}`, () => save(`${picture.id}.csv`, csv(numbers(picture)))));
  figure.classList.add('live');
};

// Pictures are made when they come near; until then the page shows them as they were drawn for it.
const near = new IntersectionObserver(entries => entries.forEach(e => { if (e.isIntersecting) { near.unobserve(e.target); make(e.target); } }),
                                      {rootMargin: '600px'});
document.querySelectorAll('figure.picture').forEach(figure => near.observe(figure));

const dark = matchMedia('(prefers-color-scheme: dark)');
const repaint = () => plots.forEach(plot => plot.u.redraw());
const theme = button('Dark', 'Change between light and dark', () => {
  const root = document.documentElement, was = root.dataset.theme ?? (dark.matches ? 'dark' : 'light');
  root.dataset.theme = was === 'dark' ? 'light' : 'dark';
  theme.textContent = was === 'dark' ? 'Dark' : 'Light';
  repaint();
});
theme.className = 'theme';
theme.textContent = dark.matches ? 'Light' : 'Dark';
dark.addEventListener('change', repaint);
document.querySelector('header').append(theme);

document.querySelectorAll('td code').forEach(code => code.after(' ', button('Copy', `Copy ${code.textContent}`, () => copied(code.textContent))));
document.querySelectorAll('.hint').forEach(hint => { hint.hidden = false; });
