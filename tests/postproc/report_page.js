// What the tests of a report ask of it in the browser (test_report_page.cpp). Every answer is one line of the console.
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
