// The table: only the rows in sight are in the document, so that its length does not matter.

const kRowHeight = 60;
const kRowsBeyondSight = 8;
const kWordOrder = new Intl.Collator('en', {numeric: true, sensitivity: 'base'});

const kLookWidth = 124;
const kLeastNameWidth = 180;

const kNameColumn = {name: 'name', title: 'Panorama', text: true, value: p => `${p.name} ${p.variant}`};

class List {
  // `open(index)` is called when a panorama is chosen.
  constructor(panoramas, open) {
    this.panoramas = panoramas;
    this.figures = kFigures.filter(figure => figure.title && panoramas.some(p => hasFigure(figure, p)));
    this.columns = [kNameColumn, ...this.figures];
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
    this.more = document.getElementById('more');
    this.edge = document.getElementById('edge');
    this.makeHeadings();
    this.makeTags();
    this.nameFigures();
    this.listen();
    this.measure();
    this.update();
  }

  makeHeadings() {
    const look = element('th', 'look');
    look.scope = 'col';
    look.append(element('span', 'visually-hidden', 'Thumbnail and irradiance'));
    look.style.width = `${kLookWidth}px`;
    this.headings = this.columns.map(column => {
      const heading = element('th', column.text ? 'text name' : '');
      heading.scope = 'col';
      heading.dataset.key = column.name;
      if (column.width) heading.style.width = `calc(${column.width}px + var(--loose))`;
      const button = heading.appendChild(element('button', '', column.title));
      button.type = 'button';
      if (column.help) button.title = column.help;
      button.addEventListener('click', () => this.sortBy(column));
      return heading;
    });
    document.getElementById('headings').replaceChildren(look, ...this.headings);
    const widths = this.figures.reduce((sum, {width}) => sum + width, kLookWidth + kLeastNameWidth);
    document.documentElement.style.setProperty('--table-width', `${widths}px`);
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

  // Those that a filter may ask for.
  nameFigures() {
    const names = kFigures.filter(figure => this.panoramas.some(p => hasFigure(figure, p)))
        .flatMap(({name}, i) => [...(i ? [', '] : []), element('code', '', name)]);
    document.getElementById('figure-names').replaceChildren(...names);
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
    this.more.addEventListener('click', () => window.scrollBy(document.documentElement.clientWidth / 2, 0));
    window.addEventListener('scroll', () => this.render(), {passive: true});
    new ResizeObserver(() => this.tellMore()).observe(document.body);
    window.addEventListener('resize', () => { this.measure(); this.render(); });
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
    this.descending = this.sortKey === column.name ? !this.descending : !column.text;
    this.sortKey = column.name;
    for (const heading of this.headings) heading.removeAttribute('aria-sort');
    this.headings.find(h => h.dataset.key === column.name)
        .setAttribute('aria-sort', this.descending ? 'descending' : 'ascending');
    this.update();
  }

  // Whichever way it is sorted, what has no figure comes last, and equals stay in the library's order.
  sorted(indices) {
    const column = this.columns.find(c => c.name === this.sortKey);
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
    const {tests, faults} = readFilter(this.filter.value, this.panoramas);
    document.getElementById('filter-told').textContent = faults.join(' ');
    document.getElementById('filter-help').hidden = faults.length > 0;
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

  // For the parts above and below the table, which are as wide as the window.
  measure() {
    document.documentElement.style.setProperty('--view-width', `${document.documentElement.clientWidth}px`);
  }

  // How many figures lie beyond the window's right edge.
  tellMore() {
    const edge = document.documentElement.clientWidth;
    const count = this.headings.filter(heading => heading.getBoundingClientRect().right > edge + 1).length;
    this.more.hidden = this.edge.hidden = count === 0;
    this.more.textContent = `${count} more figure${count === 1 ? '' : 's'} →`;
    this.table.classList.toggle('scrolled', window.scrollX > kLookWidth);
    const {top, bottom} = this.table.getBoundingClientRect();
    this.edge.style.top = `${Math.max(0, top)}px`;
    this.edge.style.bottom = `${Math.max(0, window.innerHeight - bottom)}px`;
  }

  // Puts the rows in sight into the document, with gaps for the others.
  render() {
    if (this.table.closest('[hidden]')) return this.tellMore();
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
    this.tellMore();
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
    const look = row.appendChild(element('td', 'look'));
    look.setAttribute('role', 'gridcell');
    look.append(this.makeLook(panorama));
    const name = row.appendChild(element('td', 'text name'));
    name.setAttribute('role', 'rowheader');
    name.append(...this.makeName(panorama));
    for (const figure of this.figures) {
      const value = figure.value(panorama);
      const cell = row.appendChild(element('td', figure.bad?.(value) ? 'bad' : '', figure.show(value, panorama)));
      cell.setAttribute('role', 'gridcell');
    }
    return row;
  }

  makeLook(panorama) {
    const pair = element('div', 'look-pair');
    const thumbnail = pair.appendChild(element(panorama.thumbnail ? 'img' : 'div', 'thumbnail'));
    if (!panorama.thumbnail) thumbnail.textContent = 'no picture';
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
    if (panorama.warnings.length) {
      const mark = element('span', 'bad', `⚠ ${panorama.warnings.length}`);
      mark.title = panorama.warnings.join('\n');
      mark.setAttribute('aria-hidden', 'true');  // a column tells it, too
      tags.prepend(mark);
    }
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

