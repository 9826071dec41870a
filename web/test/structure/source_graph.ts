import { readdirSync, readFileSync } from 'node:fs';
import { dirname, join, normalize } from 'node:path';
import { fileURLToPath } from 'node:url';
import ts from 'typescript';

/** From what imports to what is imported. */
export type Graph = ReadonlyMap<string, ReadonlySet<string>>;

const root = fileURLToPath(new URL('../../src', import.meta.url));

/** The page's own sources, parsed, by their path below web/src. */
export function readSources(): Map<string, ts.SourceFile> {
  const files = readdirSync(root, { recursive: true, encoding: 'utf8' });
  const own = files.filter((path) => /\.tsx?$/.test(path) && !path.endsWith('.d.ts') && !path.includes('generated'));
  return new Map(own.sort().map((path) => [path, parse(path, readFileSync(join(root, path), 'utf8'))]));
}

export function parse(path: string, text: string): ts.SourceFile {
  const kind = path.endsWith('.tsx') ? ts.ScriptKind.TSX : ts.ScriptKind.TS;
  return ts.createSourceFile(path, text, ts.ScriptTarget.Latest, true, kind);
}

/** Imports of types, dynamic imports and workers count, too. */
export function importsOf(sources: ReadonlyMap<string, ts.SourceFile>): Graph {
  const graph = new Map<string, Set<string>>();
  for (const [path, source] of sources) {
    const targets = specifiers(source).map((specifier) => normalize(join(dirname(path), specifier)));
    const found = targets.flatMap((to) => [to, `${to}.ts`, `${to}.tsx`].filter((name) => sources.has(name)));
    graph.set(path, new Set(found));
  }
  return graph;
}

function specifiers(source: ts.SourceFile): string[] {
  const found: string[] = [];
  const visit = (node: ts.Node): void => {
    if (ts.isStringLiteral(node) && node.text.startsWith('.') && leadsToModule(node.parent)) found.push(node.text);
    ts.forEachChild(node, visit);
  };
  visit(source);
  return found;
}

function leadsToModule(node: ts.Node): boolean {
  if (ts.isImportDeclaration(node) || ts.isExportDeclaration(node)) return true;
  if (ts.isCallExpression(node)) return node.expression.kind === ts.SyntaxKind.ImportKeyword;
  return ts.isNewExpression(node) && node.expression.getText() === 'URL';
}

/** The same between folders. */
export function betweenFolders(files: Graph): Graph {
  const folders = new Map<string, Set<string>>();
  for (const [from, targets] of files) {
    const folder = folders.get(dirname(from)) ?? new Set<string>();
    for (const to of targets) if (dirname(to) !== dirname(from)) folder.add(dirname(to));
    folders.set(dirname(from), folder);
  }
  return folders;
}

/** Some way from a node back to itself, with that node at both ends; null where there is none. */
export function findCycle(graph: Graph): string[] | null {
  const done = new Set<string>();
  const way: string[] = [];
  const follow = (node: string): string[] | null => {
    const at = way.indexOf(node);
    if (at >= 0) return [...way.slice(at), node];
    if (done.has(node)) return null;
    way.push(node);
    for (const next of graph.get(node) ?? []) {
      const cycle = follow(next);
      if (cycle !== null) return cycle;
    }
    way.pop();
    done.add(node);
    return null;
  };
  for (const node of graph.keys()) {
    const cycle = follow(node);
    if (cycle !== null) return cycle;
  }
  return null;
}
