// A plugin of Vite: which npm packages are in the page, and under which terms. It writes dist/third-party.json, which
// scripts/write-sbom reads, and dist/third-party.txt with their licences, which has to go wherever the page goes.
import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';

import type { Plugin } from 'vite';

interface BundledPackage {
  name: string;
  version: string;
  license: string;
  /** Its licence and notices in full. */
  text: string;
}

/** The folder of the package that a module comes from; null for our own. */
export function packageFolderOf(module: string): string | null {
  const file = module.replace(/^\0+/, '').replace(/\?.*$/, '');
  for (let folder = dirname(file); folder.includes('/node_modules/'); folder = dirname(folder)) {
    // Folders within a package may have a package.json that only tells the kind of its modules.
    const about = join(folder, 'package.json');
    if (existsSync(about) && 'version' in (JSON.parse(readFileSync(about, 'utf8')) as object)) return folder;
  }
  return null;
}

/** `beside`: further files of licences, of what its author has bundled. Throws where no licence is named, or none there. */
export function packageOf(folder: string, beside: Iterable<string> = []): BundledPackage {
  const about = JSON.parse(readFileSync(join(folder, 'package.json'), 'utf8')) as BundledPackage;
  const terms = readdirSync(folder).filter((name) => /^(licen[cs]e|copying|notice)/i.test(name));
  if (typeof about.license !== 'string' || terms.length === 0) throw new Error(`${folder} has no licence`);
  const files = [...terms.map((name) => join(folder, name)), ...beside];
  const text = files.map((file) => readFileSync(file, 'utf8').trim()).join('\n\n');
  return { name: about.name, version: about.version, license: about.license, text };
}

const rule = '-'.repeat(80);
const inText = ({ name, version, license, text }: BundledPackage) => `${name} ${version} (${license})\n\n${text}`;

/** For the page and for its workers, whose modules are known before the page is written. */
export function bundledPackages(): { page: Plugin[]; worker: () => Plugin[] } {
  const licencesBeside = new Map<string, Set<string>>();
  const collect: Plugin = {
    name: 'bundled-packages',
    generateBundle(_options, bundle) {
      for (const part of Object.values(bundle))
        for (const module of part.type === 'chunk' ? Object.keys(part.modules) : []) {
          const folder = packageFolderOf(module);
          if (folder === null) continue;
          const beside = licencesBeside.get(folder) ?? new Set();
          if (existsSync(`${module}.LICENSE.txt`)) beside.add(`${module}.LICENSE.txt`);
          licencesBeside.set(folder, beside);
        }
    },
  };
  const write: Plugin = {
    name: 'bundled-packages-files',
    enforce: 'post',
    generateBundle() {
      const packages = [...licencesBeside].map(([folder, beside]) => packageOf(folder, beside));
      packages.sort((a, b) => (a.name < b.name ? -1 : 1));
      const about = packages.map(({ name, version, license }) => ({ name, version, license }));
      const texts = packages.map(inText).join(`\n\n${rule}\n\n`);
      this.emitFile({ type: 'asset', fileName: 'third-party.txt', source: `${texts}\n` });
      this.emitFile({ type: 'asset', fileName: 'third-party.json', source: `${JSON.stringify(about, null, 2)}\n` });
    },
  };
  return { page: [collect, write], worker: () => [collect] };
}
