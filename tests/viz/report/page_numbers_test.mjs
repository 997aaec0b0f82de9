// The report's page in a real browser: its pictures, lobes, figures and texts are the panoramas'.
import assert from 'node:assert/strict';

import {browser, library, openFirst, page, run} from './page_support.mjs';

await run({
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
      return [sum, report.view.entry.figures.mean_rgb[1]];
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
    for (const quantity of ['radiance', 'irradiance', 'irradiance-over-pi']) {
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
      const largest = Math.max(...synthesisedPicture(view.lights.irradiance, view.degree, 32).rgb);
      let worst = 0;
      for (const n of [[0, 0, 1], [0.6, -0.8, 0], [-0.48, 0.6, 0.64]]) {
        gl.uniform3fv(gl.getUniformLocation(program, 'n'), n);
        gl.drawArrays(gl.POINTS, 0, 1);
        const pixel = new Float32Array(4);
        gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.FLOAT, pixel);
        const basis = basisValues(2, n);
        for (let c = 0; c < 3; ++c) {
          const value = basis.reduce((sum, y, i) => sum + y * numbers[3 * i + c], 0);
          worst = Math.max(worst, Math.abs(pixel[c] - value) / largest);
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

  // The panel tells a panorama's figures as its row does, whatever degree is looked at.
  async 'the panel says what the table says'() {
    const index = await openFirst('sky_0022');
    const panel = () => page.evaluate(`Object.fromEntries([...document.querySelectorAll('#figures > div')]
        .map(row => [row.querySelector('dt').textContent, row.querySelector('dd').textContent]))`);
    const told = await panel();
    const row = await page.evaluate(`Object.fromEntries(report.list.figures
        .map((figure, i) => [figure.name, report.list.makeRow(${index}).cells[2 + i].textContent]))`);
    const titles = await page.evaluate('kPanelTitles');
    for (const name of ['mean', 'contrast', 'directionality', 'minimum_irradiance', 'rms_error', 'key_temperature']) {
      assert.equal(told[titles[name]], row[name], name);
    }
    await page.evaluate(`document.getElementById('degree').focus()`);
    await page.press('ArrowLeft');
    assert.deepEqual(await panel(), told);
  },

  async 'nothing complained'() {
    assert.deepEqual(page.errors, []);
  },
});
