// What the tests of a report check in the browser (test_report_page.cpp). Every result is one line of the console.
'use strict';

const tell = found => console.log('found: ' + JSON.stringify(found));

/// The frame with the grains once it has drawn them. It is scrolled into the window: what nobody sees may not be drawn.
async function drawnView() {
  const frame = document.querySelector('.view');
  frame.scrollIntoView();
  while (!frame.contentDocument?.body?.dataset.ready) await new Promise(next => setTimeout(next, 20));
  return frame;
}

/// The pixels of the grains, compared with how they were when last looked at.
class Pixels {
  constructor(frame) {
    this.window = frame.contentWindow;
    this.canvas = frame.contentDocument.getElementById('scene');
  }
  async read() {
    for (let pictures = 0; pictures < 2; ++pictures) // the page draws in the first
      await new Promise(next => this.window.requestAnimationFrame(next));
    const copy = document.createElement('canvas'), pen = copy.getContext('2d');
    copy.width = this.canvas.width;
    copy.height = this.canvas.height;
    pen.drawImage(this.canvas, 0, 0);
    return pen.getImageData(0, 0, copy.width, copy.height).data;
  }
  /// Number of colours, share of pixels that are not white, and share that is not as it was.
  async look() {
    const now = await this.read(), before = this.before ?? now, colours = new Set();
    let covered = 0, changed = 0;
    for (let i = 0; i < now.length; i += 4) {
      const [red, green, blue] = now.slice(i, i + 3);
      colours.add((red << 16) | (green << 8) | blue);
      if (Math.min(red, green, blue) < 250) ++covered;
      if ([0, 1, 2].some(c => Math.abs(now[i + c] - before[i + c]) > 25)) ++changed;
    }
    this.before = now;
    return { colours: colours.size, covered: 4 * covered / now.length, changed: 4 * changed / now.length };
  }
}

function choose(frame, id, value) {
  const control = frame.contentDocument.getElementById(id);
  control.value = value;
  control.dispatchEvent(new Event('input'));
}

/// A mouse that drags; browsers know the pointer 1 as the mouse.
function drag(frame, x, y) {
  const canvas = frame.contentDocument.getElementById('scene');
  const move = (kind, share) => canvas.dispatchEvent(new frame.contentWindow.PointerEvent(kind,
    { pointerId: 1, clientX: 100 + share * x, clientY: 100 + share * y }));
  move('pointerdown', 0);
  move('pointermove', 1);
  move('pointerup', 1);
}

/// The grains after each thing that a reader can do with them, one after the other.
async function tellPixels() {
  const frame = await drawnView(), pixels = new Pixels(frame), page = frame.contentDocument;
  const steps = {
    'at first': () => {},
    'left alone': () => choose(frame, 'at', page.getElementById('at').value), // drawn again
    'turned': () => drag(frame, 150, 0),
    'cut elsewhere': () => choose(frame, 'at', 0.75),
    'cut along x': () => choose(frame, 'axis', 0),
    'whole': () => choose(frame, 'axis', -1),
    'other field': () => choose(frame, 'field', 0),
    'grain by grain': () => choose(frame, 'field', -1),
    'field again': () => choose(frame, 'field', 0),
    'other snapshot': () => choose(frame, 'snapshot', 0),
  };
  const seen = {};
  for (const [step, act] of Object.entries(steps)) {
    act();
    seen[step] = { ...await pixels.look(), state: page.getElementById('state').textContent };
  }
  tell(seen);
}

function isShown(element) {
  return element.getClientRects().length > 0 && getComputedStyle(element).visibility === 'visible';
}

/// The smallest letters, apart from exponents and indices.
function smallestText(page) {
  const walker = page.createTreeWalker(page.body, NodeFilter.SHOW_TEXT);
  let smallest = { pixels: 1000 };
  while (walker.nextNode()) {
    const text = walker.currentNode.textContent.trim(), element = walker.currentNode.parentElement;
    if (text === '' || !isShown(element) || element.closest('sup, sub')) continue;
    const pixels = parseFloat(getComputedStyle(element).fontSize);
    if (pixels < smallest.pixels) smallest = { pixels, text };
  }
  return smallest;
}

/// The box around an element that scrolls sideways, or else the page.
function boxAround(element) {
  for (let box = element; box; box = box.parentElement)
    if (['auto', 'scroll'].includes(getComputedStyle(box).overflowX)) return box;
  return document.documentElement;
}

/// How far a table hangs out: its box, out of the page; the table, out of the box that was scrolled to its end.
function describeTable(table) {
  const box = boxAround(table), cells = [...table.querySelectorAll('td, th')].filter(isShown);
  box.scrollLeft = 1e6;
  const beyond = table.getBoundingClientRect().right - box.getBoundingClientRect().right;
  box.scrollLeft = 0;
  return {
    name: table.className, beyond, out: box.getBoundingClientRect().right - document.documentElement.clientWidth,
    clipped: cells.filter(cell => cell.scrollWidth > cell.clientWidth + 1).map(cell => cell.textContent),
    tallest: Math.max(...cells.map(cell => cell.getBoundingClientRect().height)),
  };
}

function describeControl(control) {
  const { left, right, bottom, width, height } = control.getBoundingClientRect();
  return { name: control.id, left, right, bottom, width, height };
}

/// The frame from inside: its size, and what is in it.
function describeView(frame) {
  const page = frame.contentDocument, root = page.documentElement;
  const { width, height } = page.getElementById('scene').getBoundingClientRect();
  const controls = [...page.querySelectorAll('.controls input, .controls select')].filter(isShown);
  return {
    width: root.clientWidth, height: root.clientHeight, contentWidth: root.scrollWidth,
    contentHeight: page.body.getBoundingClientRect().bottom, canvas: { width, height }, smallest: smallestText(page),
    controls: controls.map(describeControl),
  };
}

/// The width of a picture before and after a click on it, and that of the page then.
function enlarge(picture) {
  const before = picture.getBoundingClientRect().width;
  picture.click();
  const root = document.documentElement;
  return { before, after: picture.getBoundingClientRect().width, contentWidth: root.scrollWidth,
    scrolls: boxAround(picture) !== root };
}

/// What is where, what hangs out and what is small, with the tables of runs open and all controls that a view can have.
async function tellLayout() {
  const frame = await drawnView(), root = document.documentElement;
  frame.contentDocument.getElementById('tools-label').hidden = false;
  document.querySelectorAll('details').forEach(runs => { runs.open = true; });
  tell({
    width: root.clientWidth, contentWidth: root.scrollWidth, smallest: smallestText(document),
    tables: [...document.querySelectorAll('table')].map(describeTable), view: describeView(frame),
    picture: enlarge(document.querySelector('img')),
  });
}

/// The addresses of all links as the browser resolves them. Those to places of this page: whether these are there.
function tellLinks() {
  const describe = link => {
    const place = link.getAttribute('href'), inside = place.startsWith('#');
    const leads = inside && document.getElementById(place.slice(1)) !== null;
    return { text: link.textContent, url: link.href, inside, leads };
  };
  tell([...document.querySelectorAll('a[href]')].map(describe));
}
