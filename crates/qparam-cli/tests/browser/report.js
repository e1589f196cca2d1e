// Opens a page in headless Chromium and uses it as people do. Arguments: the folder with playwright-core, the browser, the page,
// and `large` for a page of which only the time of the slider is asked. Prints one line of JSON; any fault ends it with 1.

import assert from 'node:assert/strict';
import { createRequire } from 'node:module';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

const [modules, executablePath, file, size] = process.argv.slice(2);
const { chromium } = createRequire(join(resolve(modules), 'package.json'))('playwright-core');
const profile = mkdtempSync(join(tmpdir(), 'qparam-browser-'));
const context = await chromium.launchPersistentContext(profile, {
  executablePath,
  headless: true,
  viewport: { width: 1200, height: 900 },
  args: ['--no-sandbox', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update',
    '--disable-sync', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'],
});
let failed = true;
try {
  await context.setOffline(true);
  const page = context.pages()[0] ?? await context.newPage();
  const complaints = [], requests = [];
  page.on('console', message => { if (['error', 'warning'].includes(message.type())) complaints.push(message.text()); });
  page.on('pageerror', error => complaints.push(String(error)));
  page.on('request', request => requests.push(request.url()));
  const url = pathToFileURL(resolve(file)).href;
  await page.goto(url);
  await page.waitForFunction(() => document.documentElement.dataset.ready, null, { timeout: 120000 });
  const ready = await page.evaluate(() => document.documentElement.dataset.ready);
  assert.equal(ready, 'live', 'WebGL is there');

  const found = size === 'large' ? await slide(page) : await use(page);
  // What a software renderer says of its own speed is no complaint of the page.
  const faults = complaints.filter(text => !/GPU stall|performance|swiftshader|Automatic fallback/i.test(text));
  assert.deepEqual(faults, [], 'the console stays silent');
  assert.deepEqual(requests.filter(request => request !== url && !request.startsWith('data:') && !request.startsWith('blob:')), [], 'nothing is asked of the network');
  console.log(JSON.stringify(found));
  failed = false;
} catch (error) {
  console.error(error);
} finally {
  await context.close();
  rmSync(profile, { recursive: true, force: true });
}
process.exit(failed ? 1 : 0);

// Two frames later, what was asked for is on the screen.
async function settle(page) {
  await page.evaluate(() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done))));
}

async function shot(page, id) {
  await settle(page);
  return (await page.locator(`#${id}`).screenshot()).toString('base64');
}

async function setQ(page, value) {
  await page.evaluate(value => {
    const slider = document.getElementById('q');
    slider.value = value;
    slider.dispatchEvent(new Event('input', { bubbles: true }));
  }, value);
  await settle(page);
}

function numbers(page) { return page.locator('#numbers td').allTextContents(); }

async function use(page) {
  // The slider changes numbers, plot and pixels; between two maps it says so.
  await setQ(page, 1);
  const conformal = [await numbers(page), await shot(page, 'space'), await shot(page, 'plane')];
  await setQ(page, 0);
  const authalic = [await numbers(page), await shot(page, 'space'), await shot(page, 'plane')];
  assert.ok(Number(conformal[0][0]) < Number(authalic[0][0]), `angle errors ${conformal[0][0]} and ${authalic[0][0]}`);
  assert.ok(Number(conformal[0][1]) > Number(authalic[0][1]), `area errors ${conformal[0][1]} and ${authalic[0][1]}`);
  assert.notEqual(conformal[1], authalic[1], 'the surface changes');
  assert.notEqual(conformal[2], authalic[2], 'the map changes');
  await setQ(page, 0.9);
  assert.ok((await numbers(page))[0].startsWith('≈'));
  assert.match(await page.locator('#between').textContent(), /Between the maps of q = 1 and 0.5/);

  // It can be used from the keyboard, and says its value.
  await page.locator('#q').focus();
  const before = await page.locator('#q').getAttribute('aria-valuetext');
  await page.keyboard.press('ArrowLeft');
  assert.notEqual(await page.locator('#q').getAttribute('aria-valuetext'), before);
  await setQ(page, 0.5);
  assert.match(await page.locator('#verdict').textContent(), /Certificate at q = 0.5: holds/);

  // Pointing at the map marks the same face on the surface.
  const plain = await shot(page, 'space');
  const pane = await page.locator('#plane').boundingBox();
  await page.mouse.move(pane.x + pane.width / 2, pane.y + pane.height / 2);
  const marked = await shot(page, 'space');
  assert.notEqual(marked, plain, 'the surface shows what the pointer is on in the map');
  assert.match(await page.locator('#hint').textContent(), /^face \d+: angle/);
  await page.mouse.move(2, 2);
  assert.equal(await shot(page, 'space'), plain, 'and no longer, once the pointer is gone');

  // Every style looks different; heat maps have their scale and histogram.
  const looks = new Set();
  for (const style of ['angle', 'area', 'stretch', 'islands', 'plain', 'checker']) {
    await page.locator(`input[value=${style}]`).check();
    looks.add(await shot(page, 'space'));
    assert.equal(await page.locator('#scale').isVisible(), ['angle', 'area', 'stretch'].includes(style));
  }
  assert.equal(looks.size, 6);
  assert.match(await page.locator('#histogram').getAttribute('aria-label'), /^Half of the faces/);

  // Turning by keyboard, flying to the worst face, and back.
  await page.locator('#space').focus();
  const start = await shot(page, 'space');
  await page.keyboard.press('ArrowRight');
  assert.notEqual(await shot(page, 'space'), start);
  const map = await shot(page, 'plane');
  await page.locator('#worst button').first().click();
  await page.waitForTimeout(800);
  assert.notEqual(await shot(page, 'plane'), map);

  // Dark and light.
  const ground = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  const day = await ground();
  await page.locator('#theme').click();
  assert.notEqual(await ground(), day);

  // Whoever uses a screen reader finds names: every control and picture has one.
  const nameless = await page.evaluate(() => [...document.querySelectorAll('input, button, svg[role=img], img, [role=application]')]
    .filter(element => !(element.getAttribute('aria-label') || element.alt || element.textContent.trim() || element.labels?.length))
    .map(element => element.outerHTML.slice(0, 80)));
  assert.deepEqual(nameless, []);
  return { looks: looks.size };
}

// Milliseconds of the slider's handler, in the median of a quick drag, and until the browser has taken the frame that it asks for.
async function slide(page) {
  return page.evaluate(async () => {
    const slider = document.getElementById('q'), handler = [], begin = performance.now();
    for (let i = 0; i < 21; i++) {
      slider.value = (i % 20) / 20 + 0.013;
      const start = performance.now();
      slider.dispatchEvent(new Event('input', { bubbles: true }));
      handler.push(performance.now() - start);
    }
    await new Promise(requestAnimationFrame);
    await new Promise(done => setTimeout(done));
    return { handler_ms: handler.sort((a, b) => a - b)[10], frame_ms: performance.now() - begin };
  });
}
