// The page: which view is on, the theme, the keys.

const kThemes = {automatic: ['◐', 'Auto'], light: ['○', 'Light'], dark: ['●', 'Dark']};

// Pages from disk may have no storage; then the theme lasts as long as the page.
function storedTheme() {
  try {
    return localStorage.getItem('shoal-theme');
  } catch {
    return null;
  }
}

function setTheme(theme) {
  if (theme === 'automatic') delete document.documentElement.dataset.theme;
  else document.documentElement.dataset.theme = theme;
  for (const button of document.querySelectorAll('[data-theme-button]')) {
    const [sign, word] = kThemes[theme];
    const picture = element('span', '', sign);
    picture.setAttribute('aria-hidden', 'true');
    button.replaceChildren(picture, ` ${word}`);
    button.title = 'Theme; press for the next one';
    button.setAttribute('aria-label', `Theme: ${word}`);
    button.dataset.themeButton = theme;
  }
  try {
    localStorage.setItem('shoal-theme', theme);
  } catch {
    return;
  }
}

class Report {
  constructor(library) {
    this.library = library;
    this.view = null;
    this.current = null;
    this.showHead();
    this.showFailed();
    this.list = new List(library.panoramas, index => this.go(index));
    this.listen();
    if (library.inline && !location.hash) this.go(0);
    this.follow();
  }

  showHead() {
    const {title, panoramas, failed, frames} = this.library;
    byId('title').textContent = title || 'Library';
    const count = panoramas.length.toLocaleString('en');
    const parts = [`${count} panorama${panoramas.length === 1 ? '' : 's'}`];
    if (failed.length) parts.push(`${failed.length} failed`);
    if (frames.length) parts.push(`frame${frames.length === 1 ? '' : 's'} ${frames.map(frame => frame.text).join(' and ')}`);
    byId('summary').replaceChildren(...parts.flatMap((part, i) => [i ? ' · ' : '', element('span', '', part)]));
    this.title = document.title;
  }

  showFailed() {
    const {failed} = this.library;
    byId('failed').hidden = failed.length === 0;
    byId('failed-title').textContent = failed.length === 1 ? 'One panorama failed' : `${failed.length} panoramas failed`;
    byId('failed-list').replaceChildren(...failed.map(({name, error}) => {
      const item = element('li');
      item.append(element('strong', '', name), element('span', 'quiet', error));
      return item;
    }));
  }

  // The address says which panorama is open, so that Back and links work.
  go(index) {
    location.hash = index === null ? '' : `panorama=${index}`;
  }

  follow() {
    const found = /^#panorama=(\d+)$/.exec(location.hash);
    const index = found && Number(found[1]) < this.library.panoramas.length ? Number(found[1]) : null;
    if (index === this.current) return;
    const before = this.current;
    this.current = index;
    byId('list-view').hidden = index !== null;
    byId('panorama-view').hidden = index === null;
    if (index === null) this.showList(before);
    else this.showPanorama(index, before);
  }

  showList(before) {
    document.title = this.title;
    window.scrollTo(...this.scrolled ?? [0, 0]);
    this.list.render();
    this.list.select(before);
  }

  showPanorama(index, before) {
    if (before === null) {
      this.scrolled ??= [0, 0];
      window.scrollTo(0, 0);
      byId('panorama-view').focus({preventScroll: true});
    }
    this.view ??= new PanoramaView(this.library);
    const place = this.list.order.indexOf(index);
    byId('place').textContent = place < 0 ? '' : `${place + 1} of ${this.list.order.length}`;
    const [previous, next] = [-1, 1].map(step => this.list.neighbour(index, step));
    byId('previous').disabled = previous === null;
    byId('next').disabled = next === null;
    this.shown = this.view.show(index).then(() => {
      // The next one is read ahead; that it cannot be is told when it is opened.
      if (next !== null && !this.library.inline) panoramaData(next).catch(() => {});
    });
  }

  step(by) {
    const index = this.list.neighbour(this.current, by);
    if (index !== null) this.go(index);
  }

  listen() {
    window.addEventListener('hashchange', () => this.follow());
    window.addEventListener('scroll', () => {
      if (this.current === null) this.scrolled = [window.scrollX, window.scrollY];
    }, {passive: true});
    byId('close').addEventListener('click', () => this.go(null));
    byId('previous').addEventListener('click', () => this.step(-1));
    byId('next').addEventListener('click', () => this.step(1));
    document.addEventListener('keydown', event => this.onKey(event));
    const themes = Object.keys(kThemes);
    const redraw = () => this.view?.lobe.draw();
    for (const button of document.querySelectorAll('[data-theme-button]')) {
      button.addEventListener('click', () => {
        setTheme(themes[(themes.indexOf(button.dataset.themeButton) + 1) % themes.length]);
        redraw();
      });
    }
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', redraw);
    const stored = storedTheme();
    setTheme(themes.includes(stored) ? stored : 'automatic');
  }

  onKey(event) {
    if (event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey) return;
    const inField = event.target.closest('input, select, textarea');
    if (this.current !== null && event.key === 'Escape') {
      this.go(null);
    } else if (this.current !== null && !inField && event.key === 'ArrowLeft') {
      this.step(-1);
    } else if (this.current !== null && !inField && event.key === 'ArrowRight') {
      this.step(1);
    } else if (this.current === null && !inField && event.key === '/') {
      byId('filter').focus();
      byId('filter').select();
    } else if (this.current === null && !inField && event.key === 'ArrowDown') {
      this.list.moveTo(this.list.active);
    } else {
      return;
    }
    event.preventDefault();
  }
}

const report = new Report(JSON.parse(byId('data').textContent));
