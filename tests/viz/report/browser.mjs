// A headless Chromium and its DevTools protocol over a pipe: messages of JSON with a 0 between them.
import {spawn} from 'node:child_process';
import {mkdtempSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';

const kFlags = [
  '--headless', '--no-sandbox', '--remote-debugging-pipe', '--use-angle=swiftshader',
  '--enable-unsafe-swiftshader', '--hide-scrollbars', '--no-first-run', '--no-default-browser-check',
  '--disable-background-networking', '--disable-component-update', '--disable-sync',
  '--disable-extensions', '--disable-default-apps', '--mute-audio', '--force-device-scale-factor=1',
  '--window-size=1440,900',
];

export class Browser {
  constructor(program) {
    this.folder = mkdtempSync(join(tmpdir(), 'shoal-page-'));
    this.process = spawn(program, [...kFlags, `--user-data-dir=${this.folder}`, 'about:blank'],
                         {stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe']});
    this.waiting = new Map();
    this.lastId = 0;
    this.onEvent = () => {};
    let rest = '';
    this.process.stdio[4].setEncoding('utf8').on('data', text => {
      const messages = (rest + text).split('\0');
      rest = messages.pop();
      for (const message of messages) this.receive(JSON.parse(message));
    });
    this.process.on('error', error => this.fail(error));
    this.process.on('exit', () => this.fail(new Error('the browser ended')));
  }

  fail(error) {
    for (const {reject} of this.waiting.values()) reject(error);
    this.waiting.clear();
  }

  receive(message) {
    if (!message.id) return this.onEvent(message.method, message.params, message.sessionId);
    const {resolve, reject} = this.waiting.get(message.id);
    this.waiting.delete(message.id);
    if (message.error) reject(new Error(message.error.message));
    else resolve(message.result);
  }

  send(method, params = {}, sessionId) {
    const id = ++this.lastId;
    this.process.stdio[3].write(JSON.stringify({id, method, params, sessionId}) + '\0');
    return new Promise((resolve, reject) => this.waiting.set(id, {resolve, reject}));
  }

  async close() {
    const ended = new Promise(resolve => this.process.on('exit', resolve));
    await this.send('Browser.close').catch(() => {});
    await ended;
    rmSync(this.folder, {recursive: true, force: true, maxRetries: 5, retryDelay: 100});
  }
}

const kKeys = {
  Enter: {code: 'Enter', windowsVirtualKeyCode: 13, text: '\r'},
  Escape: {code: 'Escape', windowsVirtualKeyCode: 27},
  Tab: {code: 'Tab', windowsVirtualKeyCode: 9},
  ArrowLeft: {code: 'ArrowLeft', windowsVirtualKeyCode: 37},
  ArrowUp: {code: 'ArrowUp', windowsVirtualKeyCode: 38},
  ArrowRight: {code: 'ArrowRight', windowsVirtualKeyCode: 39},
  ArrowDown: {code: 'ArrowDown', windowsVirtualKeyCode: 40},
  Home: {code: 'Home', windowsVirtualKeyCode: 36},
  End: {code: 'End', windowsVirtualKeyCode: 35},
  '/': {code: 'Slash', windowsVirtualKeyCode: 191, text: '/'},
};

// One page, driven by real mouse and key events; `errors` and `requests` collect what it did.
export class Page {
  static async open(browser) {
    const page = new Page();
    page.browser = browser;
    page.errors = [];
    page.requests = [];
    page.loaded = () => {};
    const {targetId} = await browser.send('Target.createTarget', {url: 'about:blank'});
    page.session = (await browser.send('Target.attachToTarget', {targetId, flatten: true})).sessionId;
    browser.onEvent = (method, params, session) => {
      if (session === page.session) page.receive(method, params);
    };
    for (const domain of ['Page', 'Runtime', 'Network', 'Log']) await page.send(`${domain}.enable`);
    await page.send('Emulation.setFocusEmulationEnabled', {enabled: true});
    return page;
  }

  receive(method, params) {
    if (method === 'Page.loadEventFired') this.loaded();
    if (method === 'Network.requestWillBeSent') this.requests.push(params.request.url);
    if (method === 'Runtime.exceptionThrown') this.errors.push(params.exceptionDetails.exception?.description);
    if (method === 'Log.entryAdded' && params.entry.level === 'error') this.errors.push(params.entry.text);
    if (method === 'Runtime.consoleAPICalled' && ['error', 'assert', 'warning'].includes(params.type)) {
      this.errors.push(params.args.map(arg => arg.value).join(' '));
    }
  }

  send(method, params) {
    return this.browser.send(method, params, this.session);
  }

  async go(url) {
    const loaded = new Promise(resolve => { this.loaded = resolve; });
    await this.send('Page.navigate', {url: 'about:blank'});
    await loaded;
    const there = new Promise(resolve => { this.loaded = resolve; });
    await this.send('Page.navigate', {url});
    await there;
  }

  async evaluate(expression) {
    const {result, exceptionDetails} =
        await this.send('Runtime.evaluate', {expression, awaitPromise: true, returnByValue: true});
    if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
    return result.value;
  }

  // Waits until the expression is true, ten seconds at most.
  async until(expression) {
    const end = Date.now() + 10000;
    while (!await this.evaluate(expression)) {
      if (Date.now() > end) throw new Error(`never true: ${expression}`);
      await new Promise(resolve => setTimeout(resolve, 20));
    }
  }

  async settle() {
    await this.evaluate('new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))');
  }

  box(selector) {
    return this.evaluate(`(() => {
      const element = document.querySelector(${JSON.stringify(selector)});
      element.scrollIntoView({block: 'nearest'});
      const {x, y, width, height} = element.getBoundingClientRect();
      return {x, y, width, height};
    })()`);
  }

  mouse(type, x, y, buttons = 0) {
    return this.send('Input.dispatchMouseEvent', {type, x, y, buttons, button: buttons || type === 'mouseReleased' ? 'left' : 'none', clickCount: 1});
  }

  async click(selector) {
    const {x, y, width, height} = await this.box(selector);
    await this.mouse('mouseMoved', x + width / 2, y + height / 2);
    await this.mouse('mousePressed', x + width / 2, y + height / 2, 1);
    await this.mouse('mouseReleased', x + width / 2, y + height / 2);
    await this.settle();
  }

  async drag(selector, dx, dy) {
    const {x, y, width, height} = await this.box(selector);
    const from = [x + width / 2, y + height / 2];
    await this.mouse('mouseMoved', ...from);
    await this.mouse('mousePressed', ...from, 1);
    for (const part of [0.5, 1]) await this.mouse('mouseMoved', from[0] + part * dx, from[1] + part * dy, 1);
    await this.mouse('mouseReleased', from[0] + dx, from[1] + dy);
    await this.settle();
  }

  async press(key) {
    await this.send('Input.dispatchKeyEvent', {type: kKeys[key].text ? 'keyDown' : 'rawKeyDown', key, ...kKeys[key]});
    await this.send('Input.dispatchKeyEvent', {type: 'keyUp', key, ...kKeys[key], text: undefined});
    await this.settle();
  }

  async type(text) {
    await this.send('Input.insertText', {text});
    await this.settle();
  }

  // What the screen shows of an element, as a PNG's base64.
  async picture(selector) {
    const box = await this.box(selector);
    await this.settle();
    const [x, y] = await this.evaluate('[scrollX, scrollY]');
    const clip = {...box, x: box.x + x, y: box.y + y, scale: 1};
    return (await this.send('Page.captureScreenshot', {clip})).data;
  }
}
