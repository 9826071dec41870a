// Renders README and the papers that it leads to as pages: node scripts/papers.mjs FOLDER [--apart] [--of REPOSITORY]
//   --apart: the pages stand without the program, so that none leads to it
//   --of: papers of another place than this repository
// Pages need no script. A link to another paper leads to its page, pictures are copied, and what is no paper is not linked.
import { copyFileSync, existsSync, mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { basename, dirname, join, normalize, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

import { Marked } from 'marked';

const here = resolve(dirname(fileURLToPath(import.meta.url)), '../..');
const [folder, ...options] = process.argv.slice(2);
const repository = options.includes('--of') ? resolve(options[options.indexOf('--of') + 1] ?? '') : here;
if (folder === undefined) {
  console.error('usage: node scripts/papers.mjs FOLDER [--apart]');
  process.exit(2);
}
const apart = options.includes('--apart');

const escaped = (text) => text.replaceAll('&', '&amp;').replaceAll('<', '&lt;').replaceAll('"', '&quot;');
const isElsewhere = (target) => /^[a-z]+:/.test(target);

/**
 * Name of a paper's page; that of README.md is readme.html, as the list of all papers is index.html, and that of
 * CHANGELOG.md changes.html, as a changelog.html in a package would have to be Debian's own.
 */
const pageOf = (paper) =>
  `${paper
    .replace(/^(docs|server|proto)\//, '')
    .replace(/\/README\.md$/, '')
    .replace(/\.md$/, '')
    .replace('CHANGELOG', 'changes')
    .replaceAll('/', '-')
    .toLowerCase()}.html`;

/** As pages of repositories name a heading in an address; the second of a name has a number. */
function anchors() {
  const seen = new Map();
  return (heading) => {
    const name = heading
      .toLowerCase()
      .replace(/[^\p{L}\p{N} _-]/gu, '')
      .replace(/ /g, '-');
    const before = seen.get(name) ?? 0;
    seen.set(name, before + 1);
    return before === 0 ? name : `${name}-${before}`;
  };
}

const read = (paper) => readFileSync(join(repository, paper), 'utf8');
const titleOf = (paper) => (paper === 'README.md' ? 'About ream' : (/^# (.+)$/m.exec(read(paper))?.[1] ?? paper));

/** README's part for readers, which names the papers by role. */
const byRole = () => /^## Where to read on\n([\s\S]*?)(?=^## )/m.exec(read('README.md'))?.[1] ?? '';

function linkedPapers(paper) {
  const text = paper === 'README.md' ? byRole() + read(paper) : read(paper);
  const targets = [...text.matchAll(/\]\(([^)\s#]+\.md)(#[^)]*)?\)/g)].map(([, target]) => target);
  return targets.filter((target) => !isElsewhere(target)).map((target) => normalize(join(dirname(paper), target)));
}

/** README and all that can be reached from it, in the order in which it names them. */
function allPapers() {
  const found = ['README.md'];
  for (const paper of found)
    for (const next of linkedPapers(paper))
      if (!found.includes(next) && existsSync(join(repository, next))) found.push(next);
  return found;
}

const papers = allPapers();

/** Sources of the pictures by name. */
const pictures = new Map();

function copied(paper, source) {
  const from = join(repository, dirname(paper), source);
  const other = pictures.get(basename(source)) ?? from;
  if (other !== from) throw new Error(`${from} and ${other} have the same name`);
  pictures.set(basename(source), from);
  mkdirSync(join(folder, 'pictures'), { recursive: true });
  copyFileSync(from, join(folder, 'pictures', basename(source)));
  return `pictures/${basename(source)}`;
}

/** Where a link of a paper leads from its page; null where that is no page. */
function addressOf(paper, target) {
  if (isElsewhere(target) || target.startsWith('#')) return target;
  const [path, anchor] = target.split('#');
  const other = normalize(join(dirname(paper), path));
  if (!papers.includes(other)) return null;
  return pageOf(other) + (anchor === undefined ? '' : `#${anchor}`);
}

/** The renderer's rules for one paper; fills `contents` with its sections. */
function rulesFor(paper, contents) {
  const anchorOf = anchors();
  return {
    heading({ tokens, depth, text }) {
      const inner = this.parser.parseInline(tokens);
      const plain = text.replace(/\[([^\]]*)\]\([^)]*\)/g, '$1').replaceAll('`', '');
      const id = anchorOf(plain);
      if (depth === 1) return `<h1 id="${id}">${inner}</h1>\n`;
      if (depth === 2) contents.push({ id, plain });
      const link = `<a class="anchor" href="#${id}" aria-label="Link to ${escaped(plain)}">#</a>`;
      return `<h${depth} id="${id}">${inner} ${link}</h${depth}>\n`;
    },
    link({ href, tokens, text }) {
      const address = addressOf(paper, href);
      const isPath = text.endsWith('.md') && address !== null && !isElsewhere(href);
      const inner = isPath
        ? escaped(titleOf(normalize(join(dirname(paper), href.split('#')[0]))))
        : this.parser.parseInline(tokens);
      return address === null ? inner : `<a href="${escaped(address)}">${inner}</a>`;
    },
    image: ({ href, text }) =>
      `<img src="${escaped(isElsewhere(href) ? href : copied(paper, href))}" alt="${escaped(text)}">`,
    code: ({ text }) => `<pre tabindex="0"><code>${escaped(text)}</code></pre>\n`,
  };
}

/** Refuses a table with a row of more or fewer cells than its heading: more would be left out without a word. */
function requireEvenTable(paper, { raw }) {
  const rows = raw.trim().split('\n');
  const cells = (row) =>
    row
      .trim()
      .replace(/^\||(?<!\\)\|$/g, '')
      .split(/(?<!\\)\|/).length;
  const uneven = rows.find((row) => cells(row) !== cells(rows[0]));
  if (uneven !== undefined)
    throw new Error(`${paper}: a row has ${cells(uneven)} cells, its table's heading ${cells(rows[0])}: ${uneven}`);
}

function rendered(paper, text) {
  const contents = [];
  const walkTokens = (token) => token.type === 'table' && requireEvenTable(paper, token);
  const marked = new Marked({ gfm: true, renderer: rulesFor(paper, contents), walkTokens });
  const body = marked
    .parse(text)
    .replaceAll('<table>', '<div class="table" tabindex="0"><table>')
    .replaceAll('</table>', '</table></div>');
  return { body, contents };
}

const listItem = (here) => (paper) =>
  `<li><a href="${pageOf(paper)}"${paper === here ? ' aria-current="page"' : ''}>${escaped(titleOf(paper))}</a></li>`;

function contentsOf(contents) {
  if (contents.length < 4) return '';
  const items = contents.map(({ id, plain }) => `<li><a href="#${id}">${escaped(plain)}</a></li>`);
  return `<nav class="contents" aria-label="On this page"><h2>On this page</h2><ul>${items.join('')}</ul></nav>\n`;
}

/** `here`: the paper, or null for the list of all. */
const page = (here, title, { body, contents }) => `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>${escaped(title)} - ream</title>
<link rel="icon" href="data:,">
<link rel="stylesheet" href="papers.css">
</head>
<body>
<a class="skip" href="#content">Skip to the text</a>
<header>
${apart ? '<strong>ream</strong>' : '<a href="../">ream</a>'}
<a href="index.html"${here === null ? ' aria-current="page"' : ''}>Guides</a>
<a class="to-list" href="#papers">All guides</a>
</header>
<div class="columns">
<main id="content">
${body.replace('</h1>\n', (end) => end + contentsOf(contents))}</main>
<nav id="papers" class="papers" aria-label="All guides">
<h2>All guides</h2>
<ul>${papers.map(listItem(here)).join('')}</ul>
${apart ? '' : '<p><a href="../third-party.txt">Licences of included software</a></p>'}
</nav>
</div>
</body>
</html>
`;

rmSync(folder, { recursive: true, force: true });
mkdirSync(folder, { recursive: true });
copyFileSync(join(here, 'packaging/papers.css'), join(folder, 'papers.css'));
writeFileSync(join(folder, 'index.html'), page(null, 'Guides', rendered('README.md', `# Guides\n${byRole()}`)));
// Whoever asks for the folder without a stroke behind its name.
if (!apart)
  writeFileSync(
    `${folder}.html`,
    `<!doctype html>\n<html lang="en">\n<title>Guides</title>\n<link rel="icon" href="data:,">\n<meta http-equiv="refresh" content="0; url=${basename(folder)}/">\n<a href="${basename(folder)}/">Guides</a>\n</html>\n`,
  );
for (const paper of papers)
  writeFileSync(join(folder, pageOf(paper)), page(paper, titleOf(paper), rendered(paper, read(paper))));
