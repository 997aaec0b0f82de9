// The report's page in a real browser: what a person does with it, and what it must never do.
import assert from 'node:assert/strict';
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

const folder = mkdtempSync(join(tmpdir(), 'shoal-report-'));
const browser = new Browser(chromium);
const page = await Page.open(browser);

// A report of COUNT panoramas of DEGREE, pictures WIDTH wide: its address and what it has to show.
function made(name, count, degree, width, frame = '-x,-y,+z') {
  const path = join(folder, name);
  execFileSync(makeReport, [path, count, degree, width, frame].map(String));
  return {url: pathToFileURL(join(path, 'index.html')).href,
          expected: JSON.parse(readFileSync(join(path, 'expected.json'), 'utf8'))};
}

const library = made('library', 40, 6, 128, '+z,+x,+y');
const names = () => page.evaluate(`report.list.order.map(i => report.library.panoramas[i].name)`);
const firstRow = () => page.evaluate(`document.querySelector('#rows tr[data-row] .row-name').textContent`);
const opened = index => page.until(
    `report.current === ${index} && report.view.entry === report.library.panoramas[${index}] && !!report.view.native`)
    .then(() => page.evaluate('report.shown.then(() => true)'));

async function openFirst(filter) {
  await page.go(library.url);
  await page.click('#filter');
  await page.type(filter);
  const index = await page.evaluate('report.list.order[0]');
  await page.click('#rows tr[data-row]');
  await opened(index);
  return index;
}

const tests = {
  async 'hostile names are shown letter by letter'() {
    await page.go(library.url);
    const shown = await page.evaluate(`[...document.querySelectorAll('#rows .row-name')].map(e => e.textContent)`);
    const expected = library.expected.panoramas.map(({name}) => name);
    assert.ok(shown.length > 9);
    assert.deepEqual(shown, expected.slice(0, shown.length));
    assert.equal(await page.evaluate('document.title'), 'Made skies · shoal');
    assert.equal(await page.evaluate(`document.querySelectorAll('#rows b, #failed-list img').length`), 0);
    assert.equal(await page.evaluate(`document.querySelectorAll('#failed-list li').length`), 2);
  },

  async 'a heading sorts, and sorts the other way'() {
    await page.go(library.url);
    const means = () => page.evaluate(`report.list.order.map(i => report.library.panoramas[i].figures.mean)`);
    await page.click('th[data-key="mean"] button');
    const falling = await means();
    assert.deepEqual(falling, falling.toSorted((a, b) => b - a));
    assert.equal(await page.evaluate(`document.querySelector('th[data-key="mean"]').ariaSort`), 'descending');
    await page.click('th[data-key="mean"] button');
    assert.deepEqual(await means(), falling.toReversed());
    await page.click('th[data-key="name"] button');
    assert.equal(await firstRow(), (await names())[0]);
  },

  async 'words, tags and figures filter'() {
    await page.go(library.url);
    await page.press('/');
    assert.equal(await page.evaluate('document.activeElement.id'), 'filter');
    await page.type('sky_001');
    assert.deepEqual(await names(), Array.from({length: 10}, (_, i) => `sky_001${i}`));
    assert.equal(await page.evaluate(`document.querySelectorAll('#rows tr[data-row]').length`), 10);
    await page.type(' tag:red');
    assert.deepEqual(await names(), ['sky_0014', 'sky_0019']);
    await page.press('Escape');
    assert.equal((await names()).length, 40);
    await page.type('dominance>0.4 dominance<0.5');
    const kept = await names();
    const expected = await page.evaluate(
        `report.library.panoramas.filter(p => p.figures.dominance > 0.4 && p.figures.dominance < 0.5).map(p => p.name)`);
    assert.ok(kept.length > 0 && kept.length < 40);
    assert.deepEqual(kept, expected);
    await page.type(' nothingiscalledthis');
    assert.equal(await page.evaluate(`document.getElementById('nothing').hidden`), false);
  },

  async 'the keyboard opens, steps and closes'() {
    await page.go(library.url);
    await page.press('/');
    await page.type('sky_00');
    await page.press('Enter');
    assert.equal(await page.evaluate(`document.activeElement.dataset.row`), '9');
    await page.press('ArrowDown');
    await page.press('Enter');
    await opened(10);
    assert.equal(await page.evaluate(`document.getElementById('name').textContent`), 'sky_0010');
    assert.equal(await page.evaluate(`document.getElementById('list-view').hidden`), true);
    await page.press('ArrowRight');
    await opened(11);
    await page.press('ArrowLeft');
    await page.press('ArrowLeft');
    await opened(9);
    await page.press('Escape');
    await page.until('report.current === null');
    assert.equal(await page.evaluate(`document.activeElement.dataset.row`), '9');
    await page.press('End');
    assert.equal(await page.evaluate(`document.activeElement.dataset.row`), '39');
  },

  async 'the lobe turns under the mouse and under the arrow keys'() {
    await openFirst('sky_0020');
    const still = await page.picture('#lobe');
    assert.ok(await page.picture('#lobe') === still);
    await page.drag('#lobe', 90, 30);
    assert.ok(await page.picture('#lobe') !== still);
    await page.evaluate(`document.getElementById('lobe').focus()`);
    await page.press('Home');
    const home = await page.picture('#lobe');
    await page.press('ArrowLeft');
    assert.ok(await page.picture('#lobe') !== home);
    await page.press('Home');
    assert.ok(await page.picture('#lobe') === home);
    assert.equal(await page.evaluate('report.current'), 20);
  },

  async 'quantity, colour, channel and degree change the lobe'() {
    await openFirst('sky_0020');
    const seen = [await page.picture('#lobe')];
    for (const control of ['#quantity label:nth-child(2)', '#colour label:nth-child(2)']) {
      await page.click(control);
      seen.push(await page.picture('#lobe'));
    }
    await page.evaluate(`document.getElementById('degree').focus()`);
    await page.press('ArrowLeft');
    for (let i = 0; i < 4; ++i) await page.press('ArrowLeft');
    assert.equal(await page.evaluate('report.view.degree'), 1);
    seen.push(await page.picture('#lobe'));
    assert.equal(new Set(seen).size, seen.length);
    assert.equal(await page.evaluate('report.view.lobe.draw(), report.view.lobe.gl.getError()'), 0);
    assert.equal(await page.evaluate(`document.querySelectorAll('#coefficients td').length`), 4 * 5);
  },

  // To degree 1 a luminance is a + b cos(angle to the dominant direction), largest in it; the surface's
  // grid is 1.5 degrees wide, half a diagonal 1.06 degrees.
  async 'the lobe lies along the dominant direction of the frame'() {
    await openFirst('sky_0020');
    await page.evaluate(`document.getElementById('degree').focus()`);
    for (let i = 0; i < 5; ++i) await page.press('ArrowLeft');
    const cosine = await page.evaluate(`(() => {
      const {positions} = report.view.lobe.mesh;
      let best = [0, 0, 0];
      for (let i = 0; i < positions.length; i += 3) {
        const p = positions.slice(i, i + 3);
        if (Math.hypot(...p) > Math.hypot(...best)) best = p;
      }
      return dot(best, report.view.entry.figures.direction) / Math.hypot(...best);
    })()`);
    assert.ok(cosine > Math.cos(1.1 * Math.PI / 180), `cosine ${cosine}`);
  },

  async 'one exposure changes all three pictures'() {
    await openFirst('sky_0020');
    const ids = ['#picture-radiance', '#picture-reconstruction', '#picture-irradiance'];
    const before = [];
    for (const id of ids) before.push(await page.picture(id));
    await page.evaluate(`document.getElementById('exposure').focus()`);
    for (let i = 0; i < 15; ++i) await page.press('ArrowRight');
    assert.ok(Math.abs(await page.evaluate('Number(document.getElementById("exposure").value)') - 1.5) < 1e-9);
    for (const [i, id] of ids.entries()) assert.ok(await page.picture(id) !== before[i], id);
    assert.equal(await page.evaluate('report.current'), 20);
  },

  // RGBE errs by 1/256 of a texel's largest channel; the texels are made again from nothing here: the
  // mean of the picture is L_00 / sqrt(4 pi), but for the 64x32 sum behind it and RGBE's rounding.
  async 'the picture is the panorama'() {
    await openFirst('sky_0021');
    const [mean, expected] = await page.evaluate(`(() => {
      const {width, height, rgb} = report.view.picture;
      let sum = 0;
      for (let row = 0; row < height; ++row) {
        const area = (Math.cos(Math.PI * row / height) - Math.cos(Math.PI * (row + 1) / height)) / 2 / width;
        for (let i = row * width; i < (row + 1) * width; ++i) sum += area * rgb[3 * i + 1];
      }
      return [sum, report.view.entry.figures.meanRgb[1]];
    })()`);
    assert.ok(Math.abs(mean / expected - 1) < 0.02, `${mean} ${expected}`);
  },

  async 'copied text is the table, digit for digit'() {
    await browser.send('Browser.grantPermissions', {permissions: ['clipboardReadWrite', 'clipboardSanitizedWrite']});
    const index = await openFirst('comma, in');
    const expected = library.expected.panoramas[index];
    const copied = async form => {
      await page.click(`#form input[value="${form}"] + span`);
      await page.click('#copy');
      await page.until(`document.getElementById('copied').textContent === 'Copied'`);
      return page.evaluate('navigator.clipboard.readText()');
    };
    for (const quantity of ['radiance', 'irradiance']) {
      await page.click(`#quantity input[value="${quantity}"] + span`);
      const csv = await copied('csv');
      assert.equal(csv, expected.csv[quantity]);
      const rows = csv.trimEnd().split('\n').slice(1).map(row => row.split(',').slice(-5));
      const table = await copied('table');
      assert.deepEqual(table.trimEnd().split('\n').slice(1).map(row => row.split('\t')), rows);
      assert.deepEqual(await page.evaluate(
          `[...document.querySelectorAll('#coefficients tbody tr')].map(row => [...row.cells].map(cell => cell.textContent))`), rows);
      const record = JSON.parse(await copied('json'));
      assert.equal(record.panorama, expected.name);
      assert.equal(record.frame, '+z,+x,+y');
      assert.deepEqual(record.coefficients, rows.map(row => row.slice(2).map(Number)));
    }
    const glsl = await copied('glsl');
    for (const row of expected.csv.irradiance.split('\n').slice(1, 10)) {
      assert.ok(glsl.includes(`vec3(${row.split(',').slice(-3).join(', ')})`), row);
    }
  },

  // The GPU runs the snippet in single precision: 1e-5 of the largest irradiance.
  async 'the GLSL compiles and gives the irradiance'() {
    await openFirst('*/');
    const worst = await page.evaluate(`(() => {
      const view = report.view;
      const gl = document.createElement('canvas').getContext('webgl2');
      gl.getExtension('EXT_color_buffer_float');
      const compile = (type, source) => {
        const shader = gl.createShader(type);
        gl.shaderSource(shader, source);
        gl.compileShader(shader);
        if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
        return shader;
      };
      const program = gl.createProgram();
      gl.attachShader(program, compile(gl.VERTEX_SHADER, '#version 300 es\\nvoid main() { gl_Position = vec4(0, 0, 0, 1); gl_PointSize = 4.0; }'));
      gl.attachShader(program, compile(gl.FRAGMENT_SHADER, '#version 300 es\\nprecision highp float;\\n' +
          glslText({...view.record('irradiance'), degree: view.native[0].length}) +
          'uniform vec3 n;\\nout vec4 result;\\nvoid main() { result = vec4(shoal_irradiance(n), 1.0); }'));
      gl.linkProgram(program);
      gl.useProgram(program);
      gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
      gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA32F, 1, 1);
      const texture = gl.getParameter(gl.TEXTURE_BINDING_2D);
      gl.bindFramebuffer(gl.FRAMEBUFFER, gl.createFramebuffer());
      gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture, 0);
      gl.viewport(0, 0, 1, 1);
      const numbers = view.texts.irradiance.map(Number);
      let worst = 0;
      for (const n of [[0, 0, 1], [0.6, -0.8, 0], [-0.48, 0.6, 0.64]]) {
        gl.uniform3fv(gl.getUniformLocation(program, 'n'), n);
        gl.drawArrays(gl.POINTS, 0, 1);
        const pixel = new Float32Array(4);
        gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.FLOAT, pixel);
        const basis = basisValues(2, n);
        for (let c = 0; c < 3; ++c) {
          const value = basis.reduce((sum, y, i) => sum + y * numbers[3 * i + c], 0);
          worst = Math.max(worst, Math.abs(pixel[c] - value) / report.view.entry.figures.maximum);
        }
      }
      return worst;
    })()`);
    assert.ok(worst < 1e-5, `error ${worst}`);
  },

  // Both ways of the recurrence promise 2e-13 of the largest value, at most sqrt(129 / 2 pi) = 4.6; the
  // azimuth, taken by an arc tangent here, adds 64 roundings of pi.
  async 'the basis to degree 64 is the engine’s'() {
    await page.go(library.url);
    for (const {direction, values} of library.expected.basis) {
      const found = await page.evaluate(`[...basisValues(64, ${JSON.stringify(direction)})]`);
      assert.equal(found.length, 65 * 65);
      const worst = Math.max(...found.map((value, i) => Math.abs(value - values[i])));
      assert.ok(worst < 3e-12, `${direction}: ${worst}`);
    }
  },

  // C++ and the page sum over the same directions; the index has six digits, the page's sums are single.
  async 'the page measures what the table says'() {
    const index = await openFirst('sky_0022');
    const [at, figures] = await page.evaluate(
        `[irradianceFigures(report.view.native, 6), report.library.panoramas[${index}].figures]`);
    for (const key of ['minimum', 'maximum', 'negative', 'contrast']) {
      assert.ok(Math.abs(at[key] - figures[key]) < 1e-5 * figures.maximum, key);
    }
  },

  async 'the theme changes and lasts'() {
    await page.go(library.url);
    const back = () => page.evaluate('getComputedStyle(document.body).backgroundColor');
    const light = await back();
    await page.click('#list-view [data-theme-button]');
    await page.click('#list-view [data-theme-button]');
    const dark = await back();
    assert.notEqual(dark, light);
    await page.go(library.url);
    assert.equal(await back(), dark);
    await page.click('#list-view [data-theme-button]');
    assert.equal(await back(), light);
  },

  // The browser complains of the file on its own; that is taken off the list.
  async 'a file that is missing is named'() {
    const partial = made('partial', 3, 2, 32);
    rmSync(join(folder, 'partial', 'panoramas', '000001.js'));
    const complaints = page.errors.length;
    await page.go(partial.url);
    await page.click('#rows tr[data-row="1"]');
    await page.until(`!document.getElementById('note').hidden`);
    assert.equal(await page.evaluate(`document.getElementById('note').textContent`),
                 'panoramas/000001.js is not beside this page');
    assert.equal(await page.evaluate(`document.getElementById('lobe').clientWidth`), 0);
    await page.press('ArrowLeft');
    await opened(0);
    assert.ok(await page.evaluate(`document.getElementById('lobe').clientWidth`) > 0);
    page.errors.splice(complaints);
  },

  async 'one panorama is one file, and degree 64 is shown'() {
    const alone = made('alone', 1, 64, 64);
    await page.go(alone.url);
    await opened(0);
    assert.equal(await page.evaluate(`document.querySelectorAll('#coefficients tbody tr').length`), 65 * 65);
    assert.equal(await page.evaluate(`document.querySelectorAll('#energy > div').length`), 65);
    assert.equal(await page.evaluate('csvText(report.view.record("radiance"))'), alone.expected.panoramas[0].csv.radiance);
  },

  async 'a thousand panoramas load within two seconds'() {
    const many = made('many', 1000, 3, 32);
    const times = [];
    for (let i = 0; i < 3; ++i) {
      await page.go(many.url);
      await page.settle();
      times.push(await page.evaluate(`(() => {
        const timing = performance.getEntriesByType('navigation')[0];
        return [timing.domInteractive, timing.domContentLoadedEventEnd, performance.now()].map(Math.round);
      })()`));
    }
    console.log(`     interactive, content loaded, drawn (ms): ${times.map(t => t.join(' ')).join('; ')}`);
    assert.ok(Math.min(...times.map(t => t[2])) < 2000);
    assert.ok(await page.evaluate(`document.querySelectorAll('#rows tr').length`) < 60);
    // Sorting and a scroll to other rows, by the page's own clock. On two busy processors 15 to 97 ms and
    // 32 to 65 ms were seen; the bound leaves room for others who hold the processor.
    const [sorting, scrolling] = await page.evaluate(`(() => {
      const least = act => Math.min(...Array.from({length: 8}, (_, i) => {
        const began = performance.now();
        act(i);
        return performance.now() - began;
      }));
      return [least(() => report.list.sortBy(kColumns.find(column => column.key === 'contrast'))),
              least(i => { window.scrollTo(0, 6000 * (i + 1)); report.list.render(); })];
    })()`);
    console.log(`     sorting ${sorting.toFixed(1)} ms, scrolling to other rows ${scrolling.toFixed(1)} ms`);
    assert.ok(sorting < 250 && scrolling < 250);
    await page.settle();
    const inSight = await page.evaluate(`[...document.querySelectorAll('#rows tr[data-row]')]
        .some(row => row.getBoundingClientRect().top >= 0 && row.getBoundingClientRect().bottom <= innerHeight)`);
    assert.ok(inSight);
  },

  async 'nothing was asked of a network, and nothing complained'() {
    const elsewhere = page.requests.filter(url => !/^(file|data|about):/.test(url));
    assert.deepEqual(elsewhere, []);
    assert.ok(page.requests.some(url => url.endsWith('.js')));
    assert.ok(page.requests.some(url => url.endsWith('.png')));
    assert.deepEqual(page.errors, []);
  },

  // The policy, not the page's good will, keeps it on disk; last, because refusals are complaints.
  async 'the policy refuses the network and foreign scripts'() {
    await page.go(library.url);
    const refused = await page.evaluate(`new Promise(resolve => {
      const refused = [];
      document.addEventListener('securitypolicyviolation', event => {
        refused.push(event.effectiveDirective);
        if (refused.length === 3) resolve(refused.sort());
      });
      fetch('http://127.0.0.1:9/').catch(() => {});
      new Image().src = 'http://127.0.0.1:9/x.png';
      const script = document.createElement('script');
      script.textContent = 'window.broken = true';
      document.head.append(script);
      setTimeout(() => resolve(refused), 3000);
    })`);
    assert.deepEqual(refused, ['connect-src', 'img-src', 'script-src-elem']);
    assert.equal(await page.evaluate('window.broken'), undefined);
  },
};

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
