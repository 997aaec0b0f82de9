// One panorama: its pictures at one exposure, its lobe, figures and coefficients.

const kMapHeight = 128;       // of synthesised pictures
const kDecodedAtOnce = 8;
const kEnergyDecades = 4;     // that the bars' logarithmic scale shows: from all to 0.01 %
const kQuantities = {radiance: 'radiance', irradiance: 'irradiance', 'irradiance-over-pi': 'irradiance / π'};
const kWideBars = 10;         // as many bars have room for their numbers lying

function byId(id) {
  return document.getElementById(id);
}

// Panoramas' data, read by adding their scripts to the page: a page from disk may read nothing
// else. Each file calls shoalPanorama.
const arrivals = new Map();

function shoalPanorama(index, data) {
  arrivals.get(index)?.resolve(data);
}

function panoramaData(index) {
  if (!arrivals.has(index)) {
    const arrival = {};
    arrival.promise = new Promise((resolve, reject) => { Object.assign(arrival, {resolve, reject}); });
    arrivals.set(index, arrival);
    const script = document.createElement('script');
    script.src = `panoramas/${String(index).padStart(6, '0')}.js`;
    script.onload = () => script.remove();
    script.onerror = () => {
      script.remove();
      arrivals.delete(index);
      arrival.reject(new Error(`${script.getAttribute('src')} is not beside this page`));
    };
    document.head.append(script);
    const oldest = arrivals.keys().next().value;
    if (arrivals.size > kDecodedAtOnce) arrivals.delete(oldest);
  }
  return arrivals.get(index).promise;
}

async function decodedPanorama(data) {
  const canInflate = 'DecompressionStream' in window;
  return {
    picture: data.rgbe && canInflate ? await decodedPicture(data.rgbe, data.width, data.height) : null,
    note: data.rgbe && !canInflate ? 'This browser is too old to show the picture.' : sentence(data.note),
    native: decodedCoefficients(data.native),
    texts: Object.fromEntries(Object.keys(kQuantities).map(quantity => [quantity, data[quantity].split(' ')])),
  };
}

function chosen(group) {
  return document.querySelector(`input[name="${group}"]:checked`).value;
}

// A text that begins with a word, not with a file's name, begins with a capital.
function sentence(text) {
  return /^[a-z]+ /.test(text) ? text[0].toUpperCase() + text.slice(1) : text;
}

// Figures of the panel, by their names.
const kPanelTitles = {
  mean: 'Mean luminance', contrast: 'Contrast', directionality: 'Directionality',
  minimum_irradiance: 'Least irradiance / mean', negative_fraction: 'Irradiance below 0',
  rms_error: 'Irradiance error, RMS', max_error: 'Irradiance error, largest', key_temperature: 'Key colour',
  fill_temperature: 'Fill colour',
};

class PanoramaView {
  constructor(library) {
    this.library = library;
    this.lobe = new LobeView(byId('lobe'), byId('axes'), library.frames[0]);
    if (!this.lobe.gl) byId('lobe-scale').textContent = 'This browser has no WebGL, which the lobe needs.';
    this.wish = null;  // the degree asked for; null for all there is
    this.listen();
  }

  listen() {
    byId('exposure').addEventListener('input', () => this.showPictures());
    byId('automatic').addEventListener('change', () => this.showPictures());
    byId('degree').addEventListener('input', event => {
      this.wish = Number(event.target.value);
      this.degree = this.wish;
      this.showLight();
    });
    for (const id of ['quantity', 'colour', 'channel']) byId(id).addEventListener('change', () => this.showLobe());
    byId('quantity').addEventListener('change', () => { this.showEnergy(); this.showCoefficients(); });
    byId('form').addEventListener('change', () => this.showCoefficients());
    byId('copy').addEventListener('click', () => this.copy());
    byId('coefficients').addEventListener('scroll', () => this.tellMore(), {passive: true});
    new ResizeObserver(() => this.tellMore()).observe(byId('coefficients'));
  }

  // The promise is kept when the panorama is on the page, or when another has been asked for.
  async show(index) {
    this.index = index;
    this.entry = this.library.panoramas[index];
    this.frame = this.library.frames[this.entry.frame];
    this.showHead();
    let shown;
    try {
      shown = await decodedPanorama(this.library.inline || await panoramaData(index));
    } catch (error) {
      shown = {picture: null, note: error.message, native: null};
    }
    if (this.index !== index) return;
    Object.assign(this, shown);
    byId('panorama-view').classList.toggle('without-light', !this.native);
    const slider = byId('degree');
    const most = this.native ? degreeOf(this.native) : 0;
    slider.max = most;
    this.degree = Math.min(this.wish ?? most, most);
    slider.value = this.degree;
    if (this.native) {
      const irradiance = irradianceOf(this.native);
      const overPi = irradiance.map(channel => channel.map(value => value / Math.PI));
      this.lights = {radiance: this.native, irradiance, 'irradiance-over-pi': overPi};
      this.wholeLobes = {};
      this.showFigures();
      this.showLight();
    } else {
      this.showPictures();
    }
  }

  showHead() {
    const {name, variant, file, pixels, tags, warnings} = this.entry;
    byId('name').textContent = name;
    const facts = [variant, file !== name && file, sizeText(pixels), pixels && pixels.format, ...tags];
    byId('subtitle').textContent = facts.filter(fact => fact && fact !== '–').join(' · ');
    byId('warnings').hidden = warnings.length === 0;
    byId('warnings').replaceChildren(...warnings.map(warning => element('p', '', sentence(warning))));
    byId('frame-text').textContent = `frame ${this.frame.text}: where the picture’s centre, right and up lie`;
    document.title = `${name} · shoal`;
  }

  // All that depends on the degree.
  showLight() {
    byId('degree-text').textContent = `${this.degree} of ${degreeOf(this.native)}`;
    byId('degree').setAttribute('aria-valuetext', byId('degree-text').textContent);
    this.reconstruction = synthesisedPicture(this.native, this.degree, kMapHeight);
    this.irradianceMap = synthesisedPicture(this.lights['irradiance-over-pi'], this.degree, kMapHeight);
    this.showPictures();
    this.showLobe();
    this.showEnergy();
    this.showCoefficients();
  }

  exposure() {
    const stops = Number(byId('exposure').value);
    return 2 ** stops * (byId('automatic').checked ? this.entry.exposure : 1);
  }

  showPictures() {
    const stops = Number(byId('exposure').value);
    const factor = this.exposure();
    byId('exposure-text').textContent =
        `${stops < 0 ? '−' : '+'}${Math.abs(stops).toFixed(1)} EV (× ${figureText(factor)})`;
    byId('note').hidden = !this.note && this.picture !== null;
    byId('note').textContent = this.note || 'There is no picture of this panorama.';
    byId('picture-radiance').hidden = !this.picture;
    const blank = {width: 2, height: 1, rgb: new Float32Array(6)};
    const shown = this.native !== null;
    if (this.picture) paint(byId('picture-radiance'), this.picture, factor);
    paint(byId('picture-reconstruction'), shown ? this.reconstruction : blank, factor);
    paint(byId('picture-irradiance'), shown ? this.irradianceMap : blank, factor);
    byId('radiance-caption').textContent = this.picture ? this.entry.changed ? 'the pixels, before this light was made of them' : 'the panorama itself' : '';
    byId('reconstruction-caption').textContent = shown ? `to degree ${this.degree}; blue stripes: negative` : '';
    byId('irradiance-caption').textContent = shown ? 'what a white surface sends back' : '';
  }

  showLobe() {
    const quantity = chosen('quantity');
    const channels = this.lights[quantity];
    const channel = byId('channel').value;
    const valueOf = channel === 'luminance' ? rgb => dot(rgb, kLuminance) : rgb => rgb[channel];
    // One scale for all degrees, so that the slider shows the lobe grow.
    let scale = 0;
    const all = this.wholeLobes[quantity] ??= lobeSamples(channels, degreeOf(channels));
    for (let i = 0; i < all.length; i += 3) scale = Math.max(scale, Math.abs(valueOf(all.subarray(i, i + 3))));
    const rgb = this.degree === degreeOf(channels) ? all : lobeSamples(channels, this.degree);
    const {center, right, up} = this.frame;
    const nativeToFrame = ([x, y, z]) => center.map((_, k) => -x * center[k] - y * right[k] + z * up[k]);
    this.lobe.setFrame(this.frame);
    this.lobe.show(lobeMesh(rgb, valueOf, scale || 1, nativeToFrame), chosen('colour') === 'light' ? 1 : 0);
    byId('lobe').setAttribute('aria-label', `Lobe of the ${kQuantities[quantity]} to degree ${this.degree}`);
    byId('legend').hidden = chosen('colour') === 'light';
    if (this.lobe.gl) byId('lobe-scale').textContent = `The circles are at ${figureText(scale)}.`;
  }

  // Of all degrees that there are, as the library's table tells them.
  showFigures() {
    const {figures, pixels, quantity, degree} = this.entry;
    const rows = kFigures.filter(figure => kPanelTitles[figure.name] && hasFigure(figure, this.entry)).map(figure => {
      const value = figure.value(this.entry);
      return [kPanelTitles[figure.name], figure.show(value, this.entry), figure.bad?.(value)];
    });
    byId('figures-degree').textContent = `to degree ${degree}`;
    if (figures.direction) {
      rows.push(['Light from', directionSentence(figures), false, true]);
      rows.push(['Direction (x, y, z)', figures.direction.map(figureText).join(', '), false, true]);
    }
    rows.push(['Mean colour (r, g, b)', figures.mean_rgb.map(figureText).join(', '), false, true]);
    if (quantity !== 'radiance') rows.push(['Table holds', kQuantities[quantity], false, true]);
    if (pixels) {
      rows.push(['Pixels', pixels.count.toLocaleString('en')]);
      rows.push(['Brightest', figureText(Math.max(...pixels.maximum))]);
      for (const [title, key] of [['Not finite', 'nonfinite'], ['Negative', 'negative'], ['Clamped', 'clamped']]) {
        if (pixels[key]) rows.push([`${title} pixels`, pixels[key].toLocaleString('en'), key === 'nonfinite']);
      }
    }
    byId('figures').replaceChildren(...rows.map(([title, value, bad, wide]) => {
      const row = element('div', wide ? 'wide' : '');
      row.append(element('dt', '', title), element('dd', bad ? 'bad' : '', value));
      return row;
    }));
  }

  // Bars of the share of all energy, each with its number, on a logarithmic scale.
  showEnergy() {
    const sums = energies(this.lights[chosen('quantity')]);
    const total = sums.reduce((a, b) => a + b, 0);
    const everyLabel = Math.ceil(sums.length / 16);
    byId('energy-unit').textContent = `of the ${kQuantities[chosen('quantity')]}, all channels, as parts of all; logarithmic, from ${percentText(10 ** -kEnergyDecades)}`;
    const bars = sums.map((sum, l) => {
      const share = total > 0 ? sum / total : 0;
      const height = share > 0 ? Math.max(0, 1 + Math.log10(share) / kEnergyDecades) : 0;
      const bar = element('div', l > this.degree ? 'beyond' : '');
      bar.title = `degree ${l}: ${(100 * share).toPrecision(3)} %`;
      const fill = bar.appendChild(element('i'));
      fill.style.height = `${100 * height}%`;
      if (total > 0) fill.append(element('em', '', percentText(share)));
      const label = bar.appendChild(element('span'));
      label.append(element('b', '', l % everyLabel === 0 ? String(l) : ''));
      return bar;
    });
    byId('energy').classList.toggle('dense', bars.length > kWideBars);
    byId('energy').replaceChildren(...bars);
    byId('energy').setAttribute('aria-label', 'Energy by degree: ' + bars.map(bar => bar.title).join(', '));
  }

  record(quantity) {
    const {name, variant} = this.entry;
    return {title: variant ? `${name} ${variant}` : name, name, variant: variant || this.library.plain, quantity,
            degree: this.degree, frame: this.frame.text, texts: this.texts[quantity]};
  }

  // What Copy copies. The table's own form has tabs, for spreadsheets.
  copyText() {
    const form = chosen('form');
    if (form === 'csv') return csvText(this.record(chosen('quantity')));
    if (form === 'json') return jsonText(this.record(chosen('quantity')));
    if (form === 'glsl') return glslText(this.record('irradiance'));
    return [...byId('coefficients').querySelectorAll('tr')]
        .map(row => [...row.cells].map(cell => cell.textContent).join('\t') + '\n').join('');
  }

  showCoefficients() {
    const isTable = chosen('form') === 'table';
    const shown = isTable ? this.coefficientTable() : element('pre', '', this.copyText());
    byId('coefficients').replaceChildren(shown);
    byId('copied').textContent = '';
    this.tellMore();
    const quantity = chosen('form') === 'glsl' ? 'irradiance' : chosen('quantity');
    byId('coefficients-title').textContent = `Coefficients of the ${kQuantities[quantity]}`;
  }

  // Whether some of the coefficients lie beyond the right edge.
  tellMore() {
    const {scrollWidth, scrollLeft, clientWidth} = byId('coefficients');
    byId('coefficients-more').hidden = scrollWidth - scrollLeft <= clientWidth + 1;
  }

  coefficientTable() {
    const {degree, texts} = this.record(chosen('quantity'));
    const table = element('table');
    const head = table.appendChild(element('thead')).appendChild(element('tr'));
    head.append(...['l', 'm', 'r', 'g', 'b'].map(title => {
      const cell = element('th', '', title);
      cell.scope = 'col';
      return cell;
    }));
    for (let l = 0; l <= degree; ++l) {
      const body = table.appendChild(element('tbody'));
      for (let m = -l; m <= l; ++m) {
        const i = coefficientIndex(l, m);
        const row = body.appendChild(element('tr'));
        row.append(...[l, m, ...texts.slice(3 * i, 3 * i + 3)].map(text => element('td', '', text)));
      }
    }
    return table;
  }

  async copy() {
    const text = this.copyText();
    try {
      await navigator.clipboard.writeText(text);
    } catch {
      copyByHand(text);
    }
    byId('copied').textContent = 'Copied';
  }
}

// For browsers that have no clipboard on pages from disk.
function copyByHand(text) {
  const area = document.body.appendChild(element('textarea'));
  const focused = document.activeElement;
  area.value = text;
  area.select();
  document.execCommand('copy');
  area.remove();
  focused?.focus();
}

