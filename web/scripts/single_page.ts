// A plugin of Vite: a page that is one file. Scripts and styles go into it, and the twin's WebAssembly as an element.
import { readFileSync } from 'node:fs';

import type { Plugin } from 'vite';

/** An inline script ends at the first of these, wherever it stands; in a string of JavaScript this is the same. */
const inScript = (code: string) => code.replace(/<\/(script)/gi, '<\\/$1').replace(/<!--/g, '<\\!--');

interface Held {
  /** Files by the id of the element that is to hold them as base64. */
  elements: Readonly<Record<string, string>>;
  /** Licences of what is in those, which have to go wherever they go. */
  licences: readonly string[];
  /** third-party.json of the page that is built before: the list of all npm packages that go out. */
  others: string;
}

function mustBeIn(others: string, packages: string): void {
  const names = (list: string) => (JSON.parse(list) as { name: string }[]).map(({ name }) => name);
  const known = names(readFileSync(others, 'utf8'));
  const missing = names(packages).filter((name) => !known.includes(name));
  if (missing.length > 0) throw new Error(`${others} lacks ${missing.join(', ')}`);
}

/** `file`: of the bundle. After bundledPackages(), whose list of licences goes into the page. */
export function singlePage(file: string, { elements, licences, others }: Held): Plugin {
  return {
    name: 'single-page',
    enforce: 'post',
    generateBundle(_options, bundle) {
      const page = bundle[file];
      if (page?.type !== 'asset' || typeof page.source !== 'string') throw new Error(`there is no ${file}`);
      let html = page.source;
      let scripts = '';
      let styles = '';
      const terms = licences.map((path) => readFileSync(path, 'utf8'));
      for (const [name, part] of Object.entries(bundle)) {
        if (part === page) continue;
        if (part.type === 'chunk') scripts += `<script type="module">${inScript(part.code)}</script>\n`;
        else if (name.endsWith('.css')) styles += `<style>${String(part.source)}</style>\n`;
        else if (name === 'third-party.txt') terms.unshift(String(part.source));
        else if (name === 'third-party.json') mustBeIn(others, String(part.source));
        else throw new Error(`${name} has no place in ${file}`);
        delete bundle[name];
      }
      if (!/<script [^>]*src=/.test(html)) throw new Error(`${file} has no script`);
      html = html
        .replace(/<script [^>]*src="[^"]*"[^>]*><\/script>\s*/g, '')
        .replace(/<link rel="(stylesheet|modulepreload)"[^>]*>\s*/g, '');
      scripts += `<script type="text/plain" id="licences">\n${inScript(terms.join('\n'))}</script>\n`;
      const held = Object.entries(elements)
        .map(
          ([id, path]) =>
            `<script type="application/octet-stream" id="${id}">${readFileSync(path, 'base64')}</script>\n`,
        )
        .join('');
      // By functions: what is put in may have a "$".
      html = html.replace('</head>', () => `${styles}</head>`).replace('</body>', () => `${held}${scripts}</body>`);
      page.source = html;
    },
  };
}
