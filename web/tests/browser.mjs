// Debian's Chromium, headless, with WebGL in software, and nothing that reaches for the network.
import { chromium } from 'playwright-core';

// Where the graphics card is software, the page is composed in half the time without it.
const switches = [
  '--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-gpu-compositing',
  '--disable-gpu-rasterization', '--disable-accelerated-2d-canvas', '--disable-quic', '--no-first-run',
  '--disable-background-networking', '--disable-component-update', '--disable-sync',
];
const browsers = new Map();

/** One process for all that ask for the same switches; it ends with this one. */
function browserWith(further) {
  const key = further.join(' ');
  if (!browsers.has(key))
    browsers.set(key, chromium.launch({
      executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', headless: true, timeout: 240000, args: [...switches, ...further],
    }));
  return browsers.get(key);
}

export async function closeBrowsers() {
  for (const browser of browsers.values()) await (await browser).close();
}

/** Runs `work(context)` in a fresh profile; `further` are more switches. */
export async function inBrowser(options, work, further = []) {
  const context = await (await browserWith(further)).newContext(options);
  try {
    return await work(context);
  } finally {
    await context.close();
  }
}
