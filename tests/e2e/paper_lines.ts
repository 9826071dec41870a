// Lines of a paper as readers copy them.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';

/** The line of a paper that is this or begins so; throws where there is none, or several. */
export type FindLine = (beginning: string) => string;

const read = (name: string) => readFileSync(join(__dirname, '../..', name), 'utf8');
const blocksOf = (text: string) => [...text.matchAll(/^```.*\n([\s\S]*?)^```$/gm)].map(([, block = '']) => block);

/** Lines of blocks, those that go on joined and without their comments; and commands within the text. */
function linesOf(text: string): string[] {
  const lines = blocksOf(text)
    .join('')
    .replace(/\\\n\s*/g, '')
    .split('\n');
  const spans = [...text.replace(/^```[\s\S]*?^```$/gm, '').matchAll(/`([^`]+)`/g)].map(([, span = '']) => span);
  return [...lines.map((line) => line.replace(/\s+#.*$/, '')), ...spans.map((span) => span.replaceAll('\n', ' '))];
}

export function linesOfPaper(name: string): FindLine {
  const lines = new Set(linesOf(read(name)));
  return (beginning) => {
    if (lines.has(beginning)) return beginning;
    const [line, ...others] = [...lines].filter((one) => one.startsWith(beginning));
    if (line === undefined || others.length > 0)
      throw new Error(`${name} has ${others.length > 0 ? 'several lines' : 'no line'} that begin with ${beginning}`);
    return line;
  };
}

/** The block of a paper that begins so. */
export function blockOfPaper(name: string, beginning: string): string {
  const found = blocksOf(read(name)).find((block) => block.startsWith(beginning));
  if (found === undefined) throw new Error(`${name} has no block that begins with ${beginning}`);
  return found;
}
