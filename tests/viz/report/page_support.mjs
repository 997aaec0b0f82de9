// What the tests of the report's page share: a browser with a page, and reports made on the spot.
import {execFileSync} from 'node:child_process';
import {existsSync, mkdtempSync, readFileSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {pathToFileURL} from 'node:url';

import {Browser, Page} from './browser.mjs';

const makeReport = process.env.SHOAL_MAKE_REPORT;
const chromium = process.env.SHOAL_CHROMIUM;
if (!chromium || !existsSync(chromium)) {
  console.log('skipped: Chromium is missing');
  process.exit(77);
}

export const folder = mkdtempSync(join(tmpdir(), 'shoal-report-'));
export const browser = new Browser(chromium);
export const page = await Page.open(browser);

// A report of COUNT panoramas of DEGREE, pictures WIDTH wide: its address and what it has to show.
export function made(name, count, degree, width, frame = '-x,-y,+z') {
  const path = join(folder, name);
  execFileSync(makeReport, [path, count, degree, width, frame].map(String));
  return {url: pathToFileURL(join(path, 'index.html')).href,
          expected: JSON.parse(readFileSync(join(path, 'expected.json'), 'utf8'))};
}

export const library = made('library', 40, 6, 128, '+z,+x,+y');

export const opened = index => page.until(
    `report.current === ${index} && report.view.entry === report.library.panoramas[${index}] && !!report.view.native`)
    .then(() => page.evaluate('report.shown.then(() => true)'));

// Opens the first panorama that the filter keeps, and says which it is.
export async function openFirst(filter) {
  await page.go(library.url);
  await page.click('#filter');
  await page.type(filter);
  const index = await page.evaluate('report.list.order[0]');
  await page.click('#rows tr[data-row]');
  await opened(index);
  return index;
}

// Runs the tests in their order and ends the process.
export async function run(tests) {
  let failures = 0;
  for (const [name, test] of Object.entries(tests)) {
    try {
      await test();
      console.log(`ok   ${name}`);
    } catch (error) {
      ++failures;
      console.log(`FAIL ${name}\n     ${error.stack.replaceAll('\n', '\n     ')}`);
    }
  }
  await browser.close();
  rmSync(folder, {recursive: true, force: true});
  process.exit(failures === 0 ? 0 : 1);
}
