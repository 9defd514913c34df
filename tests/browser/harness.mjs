// A real browser on a page of the disk, and checks that say what failed.
import {existsSync} from 'node:fs';
import {createRequire} from 'node:module';
import {pathToFileURL} from 'node:url';

const require = createRequire(import.meta.url);

export const failures = [];
export const check = (holds, what) => {
  console.log(`${holds ? 'ok' : 'FAILED'}: ${what}`);
  if (!holds) failures.push(what);
};

export const skip = why => {
  console.log(`SKIPPED: ${why}`);
  process.exit(0);
};

const chromium = ['/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome'].find(existsSync);

export const browser = async () => {
  if (!chromium) skip('there is no chromium');
  let playwright;
  try {
    playwright = require('playwright-core');
  } catch {
    skip('there is no playwright-core; npm ci brings it');
  }
  return playwright.chromium.launch({executablePath: chromium, args: ['--no-sandbox', '--disable-gpu', '--force-color-profile=srgb']});
};

/// The page in a window of that size. Whatever it asks for but itself, and whatever it complains of, is
/// in `asked` and `complaints`.
export const open = async (on, file, options = {}) => {
  const context = await on.newContext({viewport: {width: 1280, height: 900}, acceptDownloads: true, ...options});
  const page = await context.newPage(), url = pathToFileURL(file).href, asked = [], complaints = [];
  page.on('request', r => { if (r.url() !== url && !/^(data|blob):/.test(r.url())) asked.push(r.url()); });
  page.on('console', m => { if (['error', 'warning'].includes(m.type())) complaints.push(m.text()); });
  page.on('pageerror', e => complaints.push(String(e)));
  await page.goto(url);
  return {context, page, asked, complaints, url};
};

/// Makes every plot of the page, as reading it to its end would.
export const readThrough = async page => {
  const figures = await page.locator('figure.picture').all();
  for (const figure of figures) {
    await figure.scrollIntoViewIfNeeded();
    await figure.locator('.canvas canvas').waitFor({timeout: 10000});
  }
  await page.evaluate(() => { scrollTo(0, 0); return document.fonts.ready; });
  return figures.length;
};
