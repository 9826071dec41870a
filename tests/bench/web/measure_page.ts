import { ServerProcess } from '../../e2e/server_process';
import { BareServer } from './bare_server';
import { asFastAsItCan, launchBrowser } from './browser';
import { tell } from './figures';
import { frameRates } from './frame_rate';
import { Sessions } from './sessions';

export async function measurePage(dataFolder: string): Promise<object> {
  const server = new ServerProcess(dataFolder);
  const bare = new BareServer();
  await server.start();
  await bare.start();
  const sessions = new Sessions(server.url);
  await sessions.ready();
  const figures: Record<string, unknown> = {};
  try {
    const browser = await launchBrowser();
    for (const caseName of ['demo', 'thesis-5-4-2']) {
      tell(caseName);
      const id = await sessions.begin(caseName, 'long');
      await bare.show(sessions.streamUrl(id));
      figures[caseName] = await frameRates(browser, server.url, bare);
      await sessions.end(id);
    }
    await browser.close();
  } finally {
    bare.dispose();
    await server.dispose();
  }
  return figures;
}
