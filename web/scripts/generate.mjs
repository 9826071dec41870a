// Writes src/wire/generated from proto: the streams' schemas with flatc, the REST interface's types with
// openapi-typescript; only when a source is newer than what is there.
import { execFileSync } from 'node:child_process';
import { existsSync, mkdirSync, readdirSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

const webFolder = resolve(dirname(fileURLToPath(import.meta.url)), '..');
const target = resolve(webFolder, 'src/wire/generated');
const schemas = ['stream', 'device'].map((name) => resolve(webFolder, `../proto/${name}.fbs`));
const contract = resolve(webFolder, '../proto/openapi.yaml');
const generated = ['stream_generated.ts', 'device_generated.ts', 'openapi.ts'].map((name) => join(target, name));
const sources = [...schemas, contract, resolve(webFolder, 'package.json')];

const outdated = generated.some(
  (file) => !existsSync(file) || sources.some((source) => statSync(file).mtimeMs < statSync(source).mtimeMs),
);
if (outdated) {
  rmSync(target, { recursive: true, force: true });
  mkdirSync(target, { recursive: true });
  generate('flatc comes with the package flatbuffers-compiler', () => {
    execFileSync(process.env.FLATC ?? 'flatc', ['--ts', '-o', target, ...schemas], { stdio: 'inherit' });
    leaveUnchecked(target);
  });
  generate('openapi-typescript comes with npm ci', () => {
    const options = ['--array-length', '--default-non-nullable=false', '--empty-objects-unknown'];
    const names = ['--root-types', '--root-types-no-schema-prefix'];
    const program = resolve(webFolder, 'node_modules/openapi-typescript/bin/cli.js');
    const call = [program, contract, '-o', join(target, 'openapi.ts'), ...options, ...names];
    execFileSync(process.execPath, call, { stdio: ['ignore', 'ignore', 'inherit'] });
  });
}

function generate(remark, work) {
  try {
    work();
  } catch (error) {
    rmSync(target, { recursive: true, force: true });
    console.error(`cannot generate ${target}: ${error.message}; ${remark}`);
    process.exit(1);
  }
}

/** flatc gives a field of flags the default 0, which TypeScript does not take for a value of the enum. */
function leaveUnchecked(folder) {
  for (const name of readdirSync(folder, { recursive: true })) {
    const file = join(folder, name);
    if (name.endsWith('.ts')) writeFileSync(file, `// @ts-nocheck\n${readFileSync(file, 'utf8')}`);
  }
}
