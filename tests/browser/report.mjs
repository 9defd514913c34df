// node report.mjs <gyrostat> <folder>: the report as a reader meets it. With GYROSTAT_SCREENSHOTS set, pictures of the
// whole pages stay in the folder, which take a third of the time.
import {execFileSync} from 'node:child_process';
import {mkdirSync, readFileSync, rmSync, statSync, writeFileSync} from 'node:fs';
import {dirname, join, resolve} from 'node:path';
import {fileURLToPath} from 'node:url';
import {browser, check, failures, open, readThrough} from './harness.mjs';

const [program, folder] = process.argv.slice(2).map(p => resolve(p)), here = dirname(fileURLToPath(import.meta.url));
const gyrostat = (...words) => execFileSync(program, words, {cwd: folder, stdio: ['ignore', 'pipe', 'pipe']}).toString();

const photograph = async (page, name) => {
  if (process.env.GYROSTAT_SCREENSHOTS) await page.screenshot({path: join(folder, name), fullPage: true});
};

const chrome = await browser();
rmSync(folder, {recursive: true, force: true});
mkdirSync(folder, {recursive: true});
gyrostat('run', join(here, 'study.json'), '--out', 'run', '--threads', '2');
gyrostat('report', 'run');
const file = join(folder, 'run/report.html');

const {context, page, asked, complaints} = await open(chrome, file);
await context.grantPermissions(['clipboard-read', 'clipboard-write']);
await page.keyboard.press('Tab');
check(await page.evaluate(() => document.activeElement.className === 'skip'), 'the first Tab reaches the link past the head');
const count = await readThrough(page);
check(count >= 12, `${count} plots`);

// Each mark of each plot, drawn alone, has left its colour on the canvas.
const drawn = await page.evaluate(async () => {
  const faults = [];
  const copy = document.createElement('canvas').getContext('2d', {willReadFrequently: true});
  const near = (a, b) => Math.abs(a[0] - b[0]) + Math.abs(a[1] - b[1]) + Math.abs(a[2] - b[2]) < 60;
  for (const plot of page.plots.values()) {
    const {u, picture} = plot, was = picture.marks.map(m => m.shown);
    if (picture.marks.some((m, i) => u.data[i + 1][0].length !== m.x.length || m.x.length !== m.y.length)) faults.push(`${picture.id}: lengths`);
    for (const [k, mark] of picture.marks.entries()) {
      if (!mark.x.some((x, i) => scales.shows(picture.x, x) && scales.shows(picture.y, mark.y[i]))) continue;
      picture.marks.forEach((m, i) => { m.shown = i === k; u.series[i + 1].show = i === k; });
      plot.refresh();
      await new Promise(requestAnimationFrame);
      const {width, height} = Object.assign(copy.canvas, {width: u.ctx.canvas.width, height: u.ctx.canvas.height});
      copy.drawImage(u.ctx.canvas, 0, 0);
      const pixels = copy.getImageData(0, 0, width, height).data;
      const wanted = (mark.kind === 'cells' ? mark.fills.map(scales.colour).map(marks.rgb) : [scales.colour(mark.colour)]).map(c => c.match(/\d+(\.\d+)?/g).map(Number));
      let hits = 0;
      for (let y = Math.ceil(u.bbox.top) + 1; y < u.bbox.top + u.bbox.height - 1 && hits < 8; ++y)
        for (let x = Math.ceil(u.bbox.left) + 1; x < u.bbox.left + u.bbox.width - 1 && hits < 8; ++x) {
          const at = 4 * (y * width + x);
          if (pixels[at + 3] > 200 && wanted.some(c => near(c, [pixels[at], pixels[at + 1], pixels[at + 2]]))) ++hits;
        }
      if (hits < 8) faults.push(`${picture.id}: ${mark.kind} ${mark.name} left ${hits} pixels`);
    }
    picture.marks.forEach((m, i) => { m.shown = was[i]; u.series[i + 1].show = was[i] !== false; });
    plot.refresh();
  }
  return faults;
});
check(drawn.length === 0, `every mark of every plot is drawn ${drawn.join('; ')}`);

const span = (id, axis = 'x') => page.evaluate(([i, a]) => {
  const s = page.plots.get(document.getElementById(i)).u.scales[a];
  return Math.log(Math.abs(s.max / s.min)) && s.distr === 3 ? Math.log(s.max / s.min) : s.max - s.min;
}, [id, axis]);
/// Where a point of a plot is on the screen.
const place = (id, kind) => page.evaluate(([i, k]) => {
  const plot = page.plots.get(document.getElementById(i)), m = plot.picture.marks.findIndex(mark => mark.kind === k && mark.shown !== false);
  const mark = plot.picture.marks[m], at = mark.x.findIndex((x, j) => j >= mark.x.length / 2 && x != null), box = plot.u.over.getBoundingClientRect();
  return {x: box.left + plot.u.valToPos(mark.x[at], 'x'), y: box.top + plot.u.valToPos(mark.y[at], 'y'), name: mark.name,
          left: box.left, top: box.top, width: box.width, height: box.height};
}, [id, kind]);
const show = async id => {
  await page.locator(`#${id} .plot`).scrollIntoViewIfNeeded();
  await page.waitForTimeout(50);
};

// Hovering, dragging, double-clicking.
await show('cell-0-heading');
let at = await place('cell-0-heading', 'line');
await page.mouse.move(at.x - 2, at.y);
await page.mouse.move(at.x, at.y);
const tip = page.locator('#cell-0-heading .tip');
check(await tip.isVisible() && /time: .* s/.test(await tip.innerText()), 'hovering tells name, time and value');
const whole = await span('cell-0-heading');
await page.mouse.move(at.left + 0.3 * at.width, at.top + 20);
await page.mouse.down();
await page.mouse.move(at.left + 0.6 * at.width, at.top + 25, {steps: 5});
await page.mouse.up();
const zoomed = await span('cell-0-heading');
check(zoomed < 0.4 * whole && zoomed > 0.2 * whole, `dragging over 0.3 of the width shows ${(zoomed / whole).toFixed(3)} of it`);
await page.mouse.dblclick(at.left + 50, at.top + 50);
await page.waitForTimeout(50);
check(await span('cell-0-heading') === whole, 'a double click shows all again');
await page.locator('#cell-0-heading .tools button').first().click();
check(await span('cell-0-heading') < whole, 'the button zooms');
await page.locator('#cell-0-heading .tools button', {hasText: 'Reset'}).click();

// The keyboard alone.
const plot = page.locator('#cell-0-boxes .plot');
await plot.focus();
await page.keyboard.press('+');
const wide = await page.evaluate(() => { const p = page.plots.get(document.getElementById('cell-0-boxes')); return p.zoomed.x; });
check(wide != null, '+ zooms');
await page.keyboard.press('0');
check(await page.evaluate(() => page.plots.get(document.getElementById('cell-0-boxes')).zoomed.x === null), '0 shows all again');
for (let i = 0, found = false; i < 60 && !found; ++i) {
  await page.keyboard.press(i % 3 ? 'ArrowRight' : 'ArrowDown');
  found = await page.evaluate(() => { const p = page.plots.get(document.getElementById('cell-0-boxes')); return !!p.picture.marks[p.told.mark].addresses; });
}
check((await page.locator('.sr[aria-live]').innerText()).includes('study:ramp:'), 'arrow keys reach an outlier and tell its address');
await page.keyboard.press('Enter');
await page.waitForTimeout(100);
const command = await page.evaluate(() => navigator.clipboard.readText());
check(/^gyrostat replay study:ramp:\d+:\w+$/.test(command), `Enter copies '${command}'`);
check(gyrostat('replay', command.split(' ')[2], '--store', 'run').includes('the same outcome, to the bit'), 'that command replays the outcome');
check(await page.locator('.plot:not([tabindex="0"])').count() === 0, 'every plot is reached by Tab');

// Legend, numbers, file.
const key = page.locator('#cell-0-ecdf .legend button').first(), before = await key.getAttribute('aria-pressed');
await key.click();
check(await key.getAttribute('aria-pressed') !== before, 'the legend hides and shows');
const coming = page.waitForEvent('download');
await page.locator('#cell-0-ecdf .tools button', {hasText: 'CSV'}).click();
const download = await coming, rows = readFileSync(await download.path(), 'utf8').trim().split('\n');
const points = await page.evaluate(() => page.plots.get(document.getElementById('cell-0-ecdf')).picture.marks.reduce((n, m) => n + m.x.length, 0));
check(download.suggestedFilename() === 'cell-0-ecdf.csv' && rows.length === points + 1, `the CSV has a head and ${points} rows`);
await page.locator('#cell-0-ecdf .tools button', {hasText: 'Numbers'}).click();
check(await page.locator('#cell-0-ecdf .numbers tbody tr').count() > 20, 'the numbers are there as a table');
await page.locator('#cell-0-ecdf .tools button', {hasText: 'Numbers'}).click();

// Light, dark, print, narrow, without script.
const paper = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
const light = await paper();
await photograph(page, 'light_1280.png');
await page.locator('button.theme').click();
const dark = await paper();
check(light !== dark, 'the button changes light and dark');
await page.waitForTimeout(100);
await photograph(page, 'dark_1280.png');
await page.emulateMedia({media: 'print'});
check(await page.locator('figure.picture.live .plot > svg').first().isVisible() && await paper() === light, 'print has pictures of lines, on white');
await page.pdf({path: join(folder, 'print.pdf'), format: 'A4', printBackground: true});
await page.emulateMedia({media: 'screen'});

const system = await open(chrome, file, {colorScheme: 'dark'});
check(await system.page.evaluate(() => getComputedStyle(document.body).backgroundColor) === dark, 'the system\'s dark is followed');
const still = await open(chrome, file, {javaScriptEnabled: false});
check(await still.page.locator('figure.picture .plot > svg path').count() > 50, 'without script the pictures are there');
await photograph(still.page, 'no_script.png');

for (const colorScheme of ['light', 'dark']) {
  const phone = await open(chrome, file, {viewport: {width: 375, height: 740}, colorScheme, deviceScaleFactor: 2, hasTouch: true});
  if (colorScheme === 'light') await readThrough(phone.page);  // it is as wide in the dark
  check(await phone.page.evaluate(() => document.documentElement.scrollWidth) <= 375, `375 px, ${colorScheme}: nothing stands out to the side`);
  await photograph(phone.page, `${colorScheme}_375.png`);
  asked.push(...phone.asked), complaints.push(...phone.complaints);
}

// A night's study: 100,000 trials.
const night = JSON.parse(readFileSync(join(here, 'study.json')));
night.cells = [{...night.cells[2], name: 'night', grid: undefined, trials: 100000, filters: ['none', 'kf', 'oracle']}];
night.cells[0].scenario.duration_s = 0.4;
writeFileSync(join(folder, 'night.json'), JSON.stringify(night));
gyrostat('run', 'night.json', '--out', 'night');
gyrostat('report', 'night');
const large = join(folder, 'night/report.html'), size = statSync(large).size;
check(size < 3 * 2 ** 20, `the page of 100,000 trials has ${size} bytes`);
const big = await open(chrome, large);
await big.page.waitForTimeout(500);
const paint = await big.page.evaluate(() => performance.getEntriesByName('first-contentful-paint')[0]?.startTime);
console.log(`first paint of 100,000 trials after ${paint?.toFixed(0)} ms`);
asked.push(...big.asked), complaints.push(...big.complaints);

// A diagnosis is a page of the same kind.
writeFileSync(join(folder, 'recording.json'), JSON.stringify({title: 'ten minutes', cells: [{name: 'a', trials: 1, filters: ['none'],
  scenario: {duration_s: 600, rate_hz: 10, random_error: {measurement_noise_std_dps: 0.02}}}]}));
gyrostat('simulate', 'recording.json', '--out', 'recording.csv');
gyrostat('diagnose', 'recording.csv', '--html', 'diagnosis.html');
const diagnosis = await open(chrome, join(folder, 'diagnosis.html'));
const lenses = await readThrough(diagnosis.page);
check(lenses >= 5, `${lenses} plots of a diagnosis`);
asked.push(...diagnosis.asked), complaints.push(...diagnosis.complaints);

check(asked.length === 0, `no request to any host ${asked.join(' ')}`);
check(complaints.length === 0, `nothing to complain of ${complaints.join(' ')}`);
await chrome.close();
console.log(`${failures.length} of the checks failed`);
process.exit(failures.length ? 1 : 0);
