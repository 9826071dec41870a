import ts from 'typescript';

export interface FunctionLength {
  name: string;
  lines: number;
}

/** Every function with a name of its own (components, methods, arrow functions that are kept), by its lines. */
export function functionLengths(sources: ReadonlyMap<string, ts.SourceFile>): FunctionLength[] {
  const found: FunctionLength[] = [];
  for (const [path, source] of sources) {
    const lineAt = (position: number) => source.getLineAndCharacterOfPosition(position).line;
    const visit = (node: ts.Node): void => {
      const name = nameOf(node);
      if (name !== null)
        found.push({ name: `${path}: ${name}`, lines: lineAt(node.getEnd()) - lineAt(node.getStart()) + 1 });
      ts.forEachChild(node, visit);
    };
    visit(source);
  }
  return found;
}

/** Null for whatever is no function with a body and a name. */
function nameOf(node: ts.Node): string | null {
  if (ts.isArrowFunction(node) || ts.isFunctionExpression(node)) {
    const { parent } = node;
    const isKept =
      ts.isVariableDeclaration(parent) || ts.isPropertyDeclaration(parent) || ts.isPropertyAssignment(parent);
    return isKept ? parent.name.getText() : null;
  }
  if (ts.isConstructorDeclaration(node)) return node.body === undefined ? null : 'constructor';
  const isNamed = ts.isFunctionDeclaration(node) || ts.isMethodDeclaration(node) || ts.isAccessor(node);
  return isNamed && node.body !== undefined ? (node.name?.getText() ?? 'default') : null;
}

/** The length that a share of all functions of more than one line does not exceed. */
export function percentile(lengths: readonly FunctionLength[], share: number): number {
  const lines = lengths.map((each) => each.lines).filter((count) => count > 1);
  lines.sort((a, b) => a - b);
  return lines[Math.ceil(share * lines.length) - 1] ?? 0;
}
