// The report's page in a real browser: what a person does with it, and what it must never do.
import assert from 'node:assert/strict';
import {rmSync} from 'node:fs';
import {join} from 'node:path';

import {folder, library, made, openFirst, opened, page, run} from './page_support.mjs';

const names = () => page.evaluate(`report.list.order.map(i => report.library.panoramas[i].name)`);
const firstRow = () => page.evaluate(`document.querySelector('#rows tr[data-row] .row-name').textContent`);

await run({
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
    await page.type('directionality>0.4 dir<50%');
    const kept = await names();
    const expected = await page.evaluate(
        `report.library.panoramas.filter(p => p.figures.directionality > 0.4 && p.figures.directionality < 0.5).map(p => p.name)`);
    assert.ok(kept.length > 0 && kept.length < 40);
    assert.deepEqual(kept, expected);
    await page.type(' nothingiscalledthis');
    assert.equal(await page.evaluate(`document.getElementById('nothing').hidden`), false);
  },

  // Every fourth panorama has no stored errors; the others have rms_error 0.001 (1 + number).
  async 'figures of quality sort and filter'() {
    await page.go(library.url);
    const errors = () => page.evaluate(`report.list.order.map(i => report.library.panoramas[i].figures.rms_error)`);
    await page.click('th[data-key="rms_error"] button');
    const falling = await errors();
    assert.deepEqual(falling.slice(0, 30), falling.slice(0, 30).toSorted((a, b) => b - a));
    assert.ok(falling.slice(30).every(error => error === null));
    await page.press('/');
    await page.type('rms>=2% key<7000');
    const kept = await page.evaluate(`report.list.order.map(i => report.library.panoramas[i].figures)`);
    assert.ok(kept.length > 0 && kept.length < 30);
    assert.ok(kept.every(figures => figures.rms_error >= 0.02 && figures.key_temperature < 7000));
  },

  async 'a filter that cannot be followed is told'() {
    const told = async text => {
      await page.go(library.url);
      await page.press('/');
      await page.type(text);
      return page.evaluate(`document.getElementById('filter-told').textContent`);
    };
    assert.match(await told('foo>3'), /No figure is called “foo”.*rms_error.*fill_temperature/);
    assert.equal((await names()).length, 40);
    assert.match(await told('m<1'), /“m” may be mean or minimum_irradiance or max_error/);
    assert.match(await told('mean>bright'), /mean is compared with a number/);
    assert.equal(await told('mean>0.5 sky'), '');
    assert.equal(await told('<b>bold</b'), '', 'a tag holds it');
  },

  // The library has every figure. A scroll bar takes 15 of 1280 pixels.
  async 'every figure is read in a window 1280 wide'() {
    await page.send('Emulation.setDeviceMetricsOverride', {width: 1265, height: 720, deviceScaleFactor: 1, mobile: false});
    await page.go(library.url);
    const [columns, width, cut] = await page.evaluate(`[report.list.figures.length, document.documentElement.scrollWidth,
        [...document.querySelectorAll('#headings button, #rows td:not(.name)')]
            .filter(cell => cell.scrollWidth > cell.clientWidth).map(cell => cell.textContent)]`);
    await page.send('Emulation.clearDeviceMetricsOverride');
    assert.equal(columns, await page.evaluate('kFigures.filter(figure => figure.title).length'));
    assert.equal(width, 1265);
    assert.deepEqual(cut, []);
  },

  // Nothing is cut off: what does not fit can be scrolled to, and both tables say so.
  async 'a narrow window scrolls both tables and says so'() {
    await page.send('Emulation.setDeviceMetricsOverride', {width: 400, height: 800, deviceScaleFactor: 1, mobile: false});
    await page.go(library.url);
    const more = () => page.evaluate(`document.getElementById('more').hidden ? 0 : parseInt(document.getElementById('more').textContent)`);
    assert.ok(await more() > 9);
    await page.evaluate('window.scrollTo(1e5, 0)');
    await page.settle();
    assert.equal(await more(), 0);
    const [name, last] = await page.evaluate(`[...document.querySelectorAll('#headings th')].slice(1)
        .map(heading => heading.getBoundingClientRect()).filter((box, i, all) => i === 0 || i === all.length - 1)
        .map(box => [box.left, box.right])`);
    assert.ok(name[0] === 0 && last[1] <= 400, 'the names stay');
    await page.evaluate('report.go(20)');
    await opened(20);
    await page.until(`!document.getElementById('coefficients-more').hidden`);
    await page.evaluate(`document.getElementById('coefficients').scrollLeft = 1e5`);
    await page.until(`document.getElementById('coefficients-more').hidden`);
    assert.ok(await page.evaluate('document.documentElement.scrollWidth') <= 400);
    await page.send('Emulation.clearDeviceMetricsOverride');
  },

  async 'directions are told in words'() {
    await page.go(library.url);
    const said = (elevation, azimuth) => page.evaluate(`directionSentence({elevation: ${elevation}, azimuth: ${azimuth}})`);
    assert.equal(await said(30.2, 180), '30° above the horizon, behind (azimuth 180°)');
    assert.equal(await said(-12, -178), '12° below the horizon, behind (azimuth −178°)');
    assert.equal(await said(0.3, -0.2), 'at the horizon, ahead (azimuth 0°)');
    assert.equal(await said(5, -90), '5° above the horizon, left (azimuth −90°)');
    assert.equal(await said(45, 136), '45° above the horizon, behind right (azimuth 136°)');
    assert.equal(await said(89, 20), 'straight above');
  },

  async 'a light without pixels shows what it has'() {
    const bare = made('bare', 3, 2, 0);
    await page.go(bare.url);
    await page.click('#rows tr[data-row="1"]');
    await opened(1);
    assert.equal(await page.evaluate(`document.getElementById('note').textContent`), 'It has no picture');
    assert.equal(await page.evaluate(`document.getElementById('picture-radiance').clientWidth`), 0);
    assert.ok(await page.evaluate(`document.getElementById('picture-reconstruction').clientWidth`) > 100);
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

  // Tab comes by every control of both views, and each is outlined; of a choice of several the one made.
  async 'every control is reached and shows its focus'() {
    for (const [view, count] of [['', 10], ['#panorama=20', 13]]) {
      await page.go(library.url + view);
      if (view) await opened(20);
      const controls = new Set();
      for (let i = 0; i < 30; ++i) {
        await page.press('Tab');
        const [name, style] = await page.evaluate(`(() => {
          const focused = document.activeElement;
          if (focused === document.body) return ['', ''];
          const shown = focused.type === 'radio' ? focused.nextElementSibling : focused;
          return [focused.outerHTML.slice(0, 80), getComputedStyle(shown).outlineStyle];
        })()`);
        if (!name) break;
        assert.notEqual(style, 'none', name);
        controls.add(name);
      }
      assert.ok(controls.size >= count, [...controls].join('\n'));
    }
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

  // viz/library/viewpoint.h: of the frame +z,+x,+y it is (1, 0.5, 1) / 1.5. The data has six digits.
  async 'the lobe is first seen from where scenes see it'() {
    await openFirst('sky_0020');
    const eye = () => page.evaluate('report.view.lobe.axes()[2]');
    const expectFirst = async () => (await eye()).forEach((value, i) => assert.ok(Math.abs(value - [2, 1, 2][i] / 3) < 1e-5));
    await expectFirst();
    const first = await eye();
    await page.drag('#lobe', 30, 0);
    const [right, up] = await page.evaluate(`report.view.lobe.axes().slice(0, 2).map(axis => dot(axis, ${JSON.stringify(first)}))`);
    assert.ok(right > 0.1 && Math.abs(up) < right, 'what was in front goes with the mouse');
    await page.evaluate(`document.getElementById('lobe').focus()`);
    await page.press('Home');
    await expectFirst();
  },

  // From above, the lobe stands before the label of the axis that points down, and no other.
  async 'labels of the axes are read in both themes'() {
    await openFirst('sky_0020');
    const labels = () => page.evaluate(`[...document.querySelectorAll('#axes span:not([hidden])')].map(e => e.textContent).sort()`);
    const all = ['+x', '+y', '+z', '−x', '−y', '−z'];
    await page.evaluate(`document.getElementById('lobe').focus()`);
    for (let i = 0; i < 12; ++i) await page.press('ArrowUp');
    assert.deepEqual(await labels(), all.filter(name => name !== '−y'));
    for (const theme of ['light', 'dark']) {
      // WCAG 2.2, contrast ratio; 4.5 is its level AA.
      const contrasts = await page.evaluate(`(() => {
        document.documentElement.dataset.theme = '${theme}';
        const luminance = colour => dot(colour.map(v => v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4), kLuminance);
        const ground = luminance(cssColour('--stage'));
        return [...document.querySelectorAll('#axes span')].map(label => {
          const style = getComputedStyle(label);
          const ink = luminance(style.color.match(/\\d+/g).slice(0, 3).map(v => v / 255));
          return style.opacity < 1 ? 0 : (Math.max(ink, ground) + 0.05) / (Math.min(ink, ground) + 0.05);
        });
      })()`);
      assert.equal(contrasts.length, 6);
      assert.ok(Math.min(...contrasts) >= 4.5, `${theme}: ${contrasts}`);
    }
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
      return [least(() => report.list.sortBy(kFigures.find(figure => figure.name === 'contrast'))),
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
});
