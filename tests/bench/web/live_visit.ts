import type { Browser, CDPSession, Page } from '@playwright/test';

import { patienceMs, viewport } from './browser';
import type { Turned } from './turned';

declare global {
  interface Window {
    /** From asking for the stream to the first picture of the whole bone, ms; null until it is drawn. */
    joinedAfterMs: number | null;
  }
}

/**
 * Runs in the page before its own scripts: notes when the page asks for its stream, and when the first picture after the
 * whole bone had come is drawn, to the last pixel.
 */
function watchJoining(): void {
  window.joinedAfterMs = null;
  let requestedMs: number | null = null;
  // eslint-disable-next-line @typescript-eslint/unbound-method
  const post = Worker.prototype.postMessage as (this: Worker, ...args: unknown[]) => void;
  Worker.prototype.postMessage = function (this: Worker, ...args: unknown[]): void {
    const request = args[0] as { kind?: string; url?: string } | undefined;
    if (request?.kind === 'open' && request.url?.includes('/stream') === true) requestedMs ??= performance.now();
    post.apply(this, args);
  };
  const afterFrame = new MessageChannel();
  let liveBefore = false;
  let drawnBefore = 0;
  const look = () => {
    liveBefore = requestedMs !== null && window.__ream.live;
    afterFrame.port2.postMessage(null);
  };
  afterFrame.port1.onmessage = () => {
    const drawn = requestedMs === null ? 0 : window.__ream.framesDrawn;
    if (!liveBefore || drawn === drawnBefore || requestedMs === null) {
      drawnBefore = drawn;
      requestAnimationFrame(look);
      return;
    }
    const gl = document.querySelector<HTMLCanvasElement>('[data-testid=bone-canvas]')?.getContext('webgl2');
    gl?.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    window.joinedAfterMs = performance.now() - requestedMs;
  };
  requestAnimationFrame(look);
}

/** Somebody who opens the live page of a session that is under way. */
export class LiveVisit {
  private constructor(
    readonly page: Page,
    /** From asking for the stream to the first picture of the whole bone, ms. */
    readonly joinedAfterMs: number,
    /** The same from the page's address on. */
    readonly openedAfterMs: number,
  ) {}

  static async begin(browser: Browser, url: string): Promise<LiveVisit> {
    const page = await browser.newPage({ viewport });
    page.setDefaultTimeout(patienceMs);
    await page.addInitScript(watchJoining);
    const beganMs = Date.now();
    await page.goto(url);
    await page.waitForFunction(() => window.joinedAfterMs !== null, null, { polling: 20 });
    const joinedAfterMs = await page.evaluate(() => window.joinedAfterMs);
    return new LiveVisit(page, joinedAfterMs ?? NaN, Date.now() - beganMs);
  }

  async end(): Promise<void> {
    await this.page.context().close();
  }

  devTools(): Promise<CDPSession> {
    return this.page.context().newCDPSession(this.page);
  }

  /** Goes so far away that the whole bone is in the picture. */
  async seeAll(): Promise<void> {
    await this.page.evaluate(async () => {
      const canvas = document.querySelector('[data-testid=bone-canvas]');
      for (let i = 0; i < 12; ++i) canvas?.dispatchEvent(new KeyboardEvent('keydown', { key: '-' }));
      await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
    });
  }

  /** How much is drawn from here on. */
  async draw(drawing: string): Promise<void> {
    await this.page.getByTestId('sections').click();
    await this.page.getByTestId('tool-drawing').selectOption(drawing);
    await this.page.getByTestId('sections').click();
  }

  /** Turns with a key, pressed at each of the browser's animation frames. */
  turn(seconds: number): Promise<Turned> {
    return this.page.evaluate(
      (turnS) =>
        new Promise<Turned>((turned) => {
          const canvas = document.querySelector<HTMLCanvasElement>('[data-testid=bone-canvas]');
          const gl = canvas?.getContext('webgl2');
          const beganMs = performance.now();
          const drawnBefore = window.__ream.framesDrawn;
          const step = () => {
            if (performance.now() - beganMs > turnS * 1000) {
              gl?.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
              turned({
                pictures: window.__ream.framesDrawn - drawnBefore,
                seconds: (performance.now() - beganMs) / 1000,
              });
              return;
            }
            canvas?.dispatchEvent(new KeyboardEvent('keydown', { key: 'ArrowLeft', cancelable: true }));
            requestAnimationFrame(step);
          };
          requestAnimationFrame(step);
        }),
      seconds,
    );
  }
}
