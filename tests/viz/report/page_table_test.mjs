// What the page copies is what stands in the run's own table, to the last byte.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdirSync, readFileSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {pathToFileURL} from 'node:url';

import {browser, folder, opened, page, run} from './page_support.mjs';

const kHeader = 'panorama,variant,quantity,l,m,r,g,b\n';

const kQuantities = 'quantities: [radiance, irradiance, irradiance_over_pi]\n';

// Turns and windows, so that no number is as simple as a light's; a name that needs quotes.
const kEntries = `
defaults: {degree: 4, frame: openexr}
panoramas:
  - {name: "sky, of noon", sky: {turbidity: 3, sun: {elevation: 50, azimuth: 30}}}
  - {name: lamp, exposure: 0.3, rotate: {yaw: 21, pitch: 7}, lights: [{disk: {direction: [1, 0.3, 0.2], radius: 10, radiance: 5}}]}
`;

// Runs a manifest, writes its report and opens it. The table's records by "panorama,variant,quantity".
async function reported(name, more) {
  const path = join(folder, name);
  mkdirSync(path);
  writeFileSync(join(path, 'library.yaml'), `shoal: 1\noutput: out\n${kEntries}${more}`);
  const shoal = (...words) => execFileSync(process.env.SHOAL_BINARY, words, {stdio: 'pipe'});
  shoal('run', join(path, 'library.yaml'));
  shoal('report', join(path, 'out'));
  const records = {};
  const table = readFileSync(join(path, 'out', 'coefficients.csv'), 'utf8');
  assert.ok(table.startsWith(kHeader));
  for (const row of table.slice(kHeader.length).match(/.*\n/g)) {
    const key = /^(.*)(,-?\d+){2}(,[^,]+){3}\n$/.exec(row)[1];
    records[key] = (records[key] ?? '') + row;
  }
  await page.go(pathToFileURL(join(path, 'out', 'report', 'index.html')).href);
  return records;
}

// All that the page copies, each panorama in each quantity.
async function copied() {
  const texts = [];
  for (let index = 0; index < await page.evaluate('report.library.panoramas.length'); ++index) {
    await page.evaluate(`report.go(${index})`);
    await opened(index);
    await page.click('#form input[value="csv"] + span');
    for (const quantity of ['radiance', 'irradiance', 'irradiance-over-pi']) {
      await page.click(`#quantity input[value="${quantity}"] + span`);
      await page.click('#copy');
      await page.until(`document.getElementById('copied').textContent === 'Copied'`);
      texts.push(await page.evaluate('navigator.clipboard.readText()'));
    }
  }
  return texts.sort();
}

const texts = records => Object.values(records).map(rows => kHeader + rows).sort();

await browser.send('Browser.grantPermissions', {permissions: ['clipboardReadWrite', 'clipboardSanitizedWrite']});
await run({
  async 'without variants'() {
    const records = await reported('single', kQuantities);
    assert.ok('lamp,plain,irradiance' in records);
    assert.deepEqual(await copied(), texts(records));
    assert.equal(await page.evaluate(`document.getElementById('name').textContent + document.getElementById('subtitle').textContent`), 'lamp');
  },

  // Each variant is told in its own frame.
  async 'with variants'() {
    const records = await reported('several', `${kQuantities}
variants:
  plain: {}
  hann: {window: hann}
  show: {matrix: [[0.9, 0.1, 0], [0.05, 0.9, 0.05], [0, 0.1, 0.9]], rotate: {roll: 33}, frame: "+x,-y,+z"}
`);
    assert.equal(Object.keys(records).length, 2 * 3 * 3);
    assert.deepEqual(await copied(), texts(records));
  },

  // The page has more than this table does.
  async 'of a table of one variant and quantity'() {
    const all = texts(await reported('one', 'quantities: [irradiance]\nvariants: {hann: {window: hann}}\n'));
    const found = await copied();
    assert.equal(all.length, 2);
    assert.deepEqual(found.filter(text => all.includes(text)), all);
  },
});
