// The table: only the rows in sight are in the document, so that its length does not matter.

const kRowHeight = 60;
const kRowsBeyondSight = 8;
const kWordOrder = new Intl.Collator('en', {numeric: true, sensitivity: 'base'});

function element(kind, className, text) {
  const made = document.createElement(kind);
  if (className) made.className = className;
  if (text !== undefined) made.textContent = text;
  return made;
}

// A number that people read: three decimals, fewer for large ones, a power of ten for very large and
// very small ones.
function figureText(value) {
  if (value === null || value === undefined) return '–';
  const size = Math.abs(value);
  let text;
  if (size !== 0 && (size < 5e-4 || size >= 1e6)) text = value.toExponential(2);
  else text = value.toFixed(size >= 1000 ? 0 : size >= 100 ? 1 : size >= 10 ? 2 : 3);
  return text.replaceAll('-', '−');
}

function angleText(value) {
  return value === undefined ? '–' : `${Math.round(value)}°`.replace('-', '−');
}

function sizeText(pixels) {
  return pixels ? `${pixels.width} × ${pixels.height}` : '–';
}

function directionText(figures) {
  if (figures.elevation === undefined) return '–';
  const side = Math.round(figures.azimuth) < 0 ? '←' : '→';
  return `${angleText(figures.elevation)} ↑  ${angleText(Math.abs(figures.azimuth))} ${side}`;
}

// What each column shows and sorts by; `only` where a column is left out if no panorama has it.
const kColumns = [
  {key: 'look', title: '', width: '156px', text: true},
  {key: 'name', title: 'Panorama', text: true, value: p => `${p.name} ${p.variant}`},
  {key: 'mean', title: 'Mean', width: '84px', help: 'Mean luminance of the radiance over the sphere',
   value: p => p.figures.mean, show: p => figureText(p.figures.mean)},
  {key: 'contrast', title: 'Contrast', width: '98px', help: '(max − min) / (max + min) of the irradiance',
   value: p => p.figures.contrast, show: p => figureText(p.figures.contrast)},
  {key: 'dominance', title: 'Dominance', width: '112px',
   help: 'How much of the light comes from one side: 0 evenly, 1 one point',
   value: p => p.figures.dominance, show: p => figureText(p.figures.dominance)},
  {key: 'elevation', title: 'Light from', width: '132px', hide: 'hide-small',
   help: 'Dominant direction: degrees above the horizon, degrees left or right of the picture’s centre',
   value: p => p.figures.elevation, show: p => directionText(p.figures)},
  {key: 'minimum', title: 'Min. irr.', width: '96px', hide: 'hide-small',
   help: 'Smallest irradiance in any direction; below zero the reconstruction rings', value: p => p.figures.minimum,
   show: p => figureText(p.figures.minimum), bad: p => p.figures.minimum < 0},
  {key: 'degree', title: 'Degree', width: '84px', hide: 'hide-medium', value: p => p.degree,
   show: p => String(p.degree)},
  {key: 'width', title: 'Pixels', width: '124px', hide: 'hide-medium', only: p => p.pixels,
   value: p => p.pixels ? p.pixels.width : null, show: p => sizeText(p.pixels)},
  {key: 'warnings', title: 'Warnings', width: '98px', hide: 'hide-medium', only: p => p.warnings.length > 0,
   value: p => p.warnings.length,
   show: p => p.warnings.length ? String(p.warnings.length) : '', bad: p => p.warnings.length > 0},
];

const kFilterFigures = {
  mean: p => p.figures.mean, contrast: p => p.figures.contrast, dominance: p => p.figures.dominance,
  elevation: p => p.figures.elevation, azimuth: p => p.figures.azimuth, minimum: p => p.figures.minimum,
  maximum: p => p.figures.maximum, degree: p => p.degree, width: p => p.pixels ? p.pixels.width : null,
};

const kComparisons = {
  '<': (a, b) => a < b, '>': (a, b) => a > b, '<=': (a, b) => a <= b, '>=': (a, b) => a >= b,
  '=': (a, b) => a === b,
};

// A filter's words as tests of a panorama. A word is FIGURE<NUMBER and the like, tag:TAG, or text that
// the name, the variant or a tag holds.
function filterTests(text) {
  return text.toLowerCase().split(/\s+/).filter(Boolean).map(word => {
    const comparison = /^([a-z]+)(<=|>=|<|>|=)(-?[\d.]+(?:e[-+]?\d+)?)$/.exec(word);
    const figure = comparison && Object.hasOwn(kFilterFigures, comparison[1]) && kFilterFigures[comparison[1]];
    if (figure) {
      const compare = kComparisons[comparison[2]], bound = Number(comparison[3]);
      return p => Number.isFinite(figure(p)) && compare(figure(p), bound);
    }
    if (word.startsWith('tag:')) return p => p.tags.some(tag => tag.toLowerCase() === word.slice(4));
    return p => [p.name, p.variant, ...p.tags].some(part => part.toLowerCase().includes(word));
  });
}

class List {
  // `open(index)` is called when a panorama is chosen.
  constructor(panoramas, open) {
    this.panoramas = panoramas;
    this.columns = kColumns.filter(({only}) => !only || panoramas.some(only));
    this.open = open;
    this.sortKey = null;
    this.descending = false;
    this.active = 0;  // place in this.order that the keyboard is at
    this.made = new Map();
    this.table = document.getElementById('table');
    this.body = document.getElementById('rows');
    this.filter = document.getElementById('filter');
    this.tag = document.getElementById('tag');
    this.warned = document.getElementById('warned');
    this.makeHeadings();
    this.makeTags();
    this.listen();
    this.update();
  }

  makeHeadings() {
    this.headings = this.columns.map(column => {
      const heading = element('th', [column.text && 'text', column.hide, column.key === 'look' && 'look'].filter(Boolean).join(' '));
      heading.scope = 'col';
      heading.dataset.key = column.key;
      if (column.width) heading.style.width = column.width;
      if (column.title) {
        const button = heading.appendChild(element('button', '', column.title));
        button.type = 'button';
        if (column.help) button.title = column.help;
        button.addEventListener('click', () => this.sortBy(column));
      } else {
        heading.setAttribute('aria-label', 'Thumbnail and irradiance');
      }
      return heading;
    });
    document.getElementById('headings').replaceChildren(...this.headings);
  }

  makeTags() {
    const tags = [...new Set(this.panoramas.flatMap(p => p.tags))].sort(kWordOrder.compare);
    document.getElementById('tag-choice').hidden = tags.length === 0;
    this.warned.closest('label').hidden = !this.panoramas.some(p => p.warnings.length > 0);
    for (const tag of tags) {
      const option = this.tag.appendChild(element('option', '', tag));
      option.value = tag;
    }
  }

  listen() {
    this.filter.addEventListener('input', () => this.update());
    this.tag.addEventListener('change', () => this.update());
    this.warned.addEventListener('change', () => this.update());
    document.getElementById('clear').addEventListener('click', () => {
      this.filter.value = this.tag.value = '';
      this.warned.checked = false;
      this.update();
      this.filter.focus();
    });
    this.filter.addEventListener('keydown', event => {
      if (event.key === 'Escape') {
        if (!this.filter.value) this.focusActive();
        this.filter.value = '';
        this.update();
      } else if (event.key === 'Enter' || event.key === 'ArrowDown') {
        this.moveTo(0);
      } else {
        return;
      }
      event.preventDefault();
    });
    this.body.addEventListener('click', event => {
      const row = event.target.closest('tr[data-row]');
      if (row) this.open(Number(row.dataset.row));
    });
    this.body.addEventListener('keydown', event => this.onRowKey(event));
    window.addEventListener('scroll', () => this.render(), {passive: true});
    window.addEventListener('resize', () => this.render());
  }

  onRowKey(event) {
    const page = Math.max(1, Math.floor(window.innerHeight / kRowHeight) - 2);
    const places = {
      ArrowDown: this.active + 1, ArrowUp: this.active - 1, PageDown: this.active + page,
      PageUp: this.active - page, Home: 0, End: this.order.length - 1,
    };
    if (event.key === 'Enter' || event.key === ' ') this.open(this.order[this.active]);
    else if (event.key in places) this.moveTo(places[event.key]);
    else return;
    event.preventDefault();
  }

  sortBy(column) {
    this.descending = this.sortKey === column.key ? !this.descending : !column.text;
    this.sortKey = column.key;
    for (const heading of this.headings) heading.removeAttribute('aria-sort');
    this.headings.find(h => h.dataset.key === column.key)
        .setAttribute('aria-sort', this.descending ? 'descending' : 'ascending');
    this.update();
  }

  // Whichever way it is sorted, what has no figure comes last, and equals stay in the library's order.
  sorted(indices) {
    const column = this.columns.find(c => c.key === this.sortKey);
    if (!column) return indices;
    const sign = this.descending ? -1 : 1;
    const values = this.panoramas.map(column.value);
    const missing = value => value === null || value === undefined;
    return indices.sort((a, b) => {
      const [x, y] = [values[a], values[b]];
      if (missing(x) || missing(y)) return missing(x) - missing(y) || a - b;
      return sign * (column.text ? kWordOrder.compare(x, y) : x - y) || a - b;
    });
  }

  update() {
    const tests = filterTests(this.filter.value);
    if (this.tag.value) tests.push(p => p.tags.includes(this.tag.value));
    if (this.warned.checked) tests.push(p => p.warnings.length > 0);
    const indices = [...this.panoramas.keys()].filter(i => tests.every(test => test(this.panoramas[i])));
    this.order = this.sorted(indices);
    this.active = 0;
    this.table.setAttribute('aria-rowcount', this.order.length + 1);
    this.table.hidden = this.order.length === 0;
    document.getElementById('nothing').hidden = this.order.length > 0 || this.panoramas.length === 0;
    document.getElementById('shown').textContent =
        tests.length ? `${this.order.length.toLocaleString('en')} of ${this.panoramas.length.toLocaleString('en')}` : '';
    this.render();
  }

  // Puts the rows in sight into the document, with gaps for the others.
  render() {
    if (this.table.closest('[hidden]')) return;
    const top = this.body.getBoundingClientRect().top;
    const first = Math.max(0, Math.floor(-top / kRowHeight) - kRowsBeyondSight);
    const last = Math.min(this.order.length, Math.ceil((window.innerHeight - top) / kRowHeight) + kRowsBeyondSight);
    const places = Array.from({length: Math.max(0, last - first)}, (_, i) => first + i);
    const focused = document.activeElement && document.activeElement.closest('#rows tr[data-row]');
    const made = new Map();
    const rows = places.map(place => {
      const index = this.order[place];
      const row = this.made.get(index) || this.makeRow(index);
      made.set(index, row);
      row.setAttribute('aria-rowindex', place + 2);
      row.tabIndex = place === this.active ? 0 : -1;
      return row;
    });
    this.made = made;
    const gaps = [first, this.order.length - Math.max(first, last)].map(count => this.makeGap(count));
    this.body.replaceChildren(gaps[0], ...rows, gaps[1]);
    if (focused && focused.isConnected) focused.focus({preventScroll: true});
  }

  makeGap(rowCount) {
    const gap = element('tr');
    gap.setAttribute('aria-hidden', 'true');
    gap.hidden = rowCount === 0;
    const cell = gap.appendChild(element('td', 'gap'));
    cell.style.height = `${rowCount * kRowHeight}px`;
    return gap;
  }

  makeRow(index) {
    const panorama = this.panoramas[index];
    const row = element('tr');
    row.dataset.row = index;
    for (const column of this.columns) {
      const cell = row.appendChild(element('td', [column.text && 'text', column.hide].filter(Boolean).join(' ')));
      cell.setAttribute('role', column.key === 'name' ? 'rowheader' : 'gridcell');
      if (column.key === 'look') {
        cell.classList.add('look');
        cell.append(this.makeLook(panorama));
      } else if (column.key === 'name') {
        cell.append(...this.makeName(panorama));
      } else {
        cell.textContent = column.show(panorama);
        if (column.bad && column.bad(panorama)) cell.classList.add('bad');
      }
    }
    return row;
  }

  makeLook(panorama) {
    const pair = element('div', 'look-pair');
    const thumbnail = pair.appendChild(element(panorama.thumbnail ? 'img' : 'div', 'thumbnail'));
    if (panorama.thumbnail) {
      thumbnail.loading = 'lazy';
      thumbnail.decoding = 'async';
      thumbnail.alt = '';
      thumbnail.src = panorama.thumbnail;
    }
    const ball = pair.appendChild(element('canvas'));
    ball.width = ball.height = 60;
    paintBall(ball, panorama.ball, panorama.exposure);
    return pair;
  }

  makeName(panorama) {
    const name = element('div', 'row-name', panorama.name);
    name.title = panorama.name;
    const tags = element('div', 'row-tags');
    if (panorama.variant) tags.append(element('span', '', panorama.variant));
    tags.append(...panorama.tags.map(tag => element('span', 'tag', tag)));
    if (panorama.warnings.length) tags.append(element('span', 'bad narrow-only', '⚠ ' + panorama.warnings[0]));
    return tags.childElementCount ? [name, tags] : [name];
  }

  // Moves the keyboard to a place in the order and shows it.
  moveTo(place) {
    if (this.order.length === 0) return;
    this.active = Math.max(0, Math.min(this.order.length - 1, place));
    const top = this.body.getBoundingClientRect().top + this.active * kRowHeight;
    const heading = this.headings[0].offsetHeight;
    if (top < heading) window.scrollBy(0, top - heading);
    if (top + kRowHeight > window.innerHeight) window.scrollBy(0, top + kRowHeight - window.innerHeight);
    this.focusActive();
  }

  focusActive() {
    this.render();
    const row = this.made.get(this.order[this.active]);
    if (row) row.focus({preventScroll: true});
  }

  // The panorama `step` places after this one in the order shown; null at the ends.
  neighbour(index, step) {
    const place = this.order.indexOf(index) + step;
    return place >= 0 && place < this.order.length ? this.order[place] : null;
  }

  select(index) {
    const place = this.order.indexOf(index);
    this.moveTo(place < 0 ? this.active : place);
  }
}

