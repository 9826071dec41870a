"""Which files of a target are compiled together, so that what they include is read once for all of them.

    compile_together.py FOLDER MOST_FILES ROOT ...

A line of FOLDER/lists is a target and its C++ sources, TARGET;PATH;PATH...; ROOTs are the folders that #include "..."
starts from. Written are FOLDER/<target>_<n>.cpp, which include the files of a group, and FOLDER/groups.cmake, which
adds them to their targets. Files that would misunderstand each other are kept apart: a name in the unnamed namespace
of one is neither in that of another of its group nor used by another for what a header declares. The order of the
lists and the names decide alone, so that the groups are the same on every machine.
"""
import functools
import os
import re
import sys

NO_CODE = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'', re.S)
INCLUDE = re.compile(r'^#include "([^"]+)"', re.M)
# In our form (.clang-format) a namespace's end says so, and what it declares starts at the beginning of a line.
UNNAMED = re.compile(r'^namespace \{\n(.*?)^\}  // namespace$', re.S | re.M)
TYPE = re.compile(r'^(?:template <.*>\s*)?(?:enum class|enum|struct|class|union)\s+(\w+)', re.M)
# What only gives something another name may be said twice.
ALIAS = re.compile(r'^(?:namespace \w+ =|using )[^;]*;', re.M)
OTHER = re.compile(r'^(?!(?:template|enum|struct|class|union)\b)(?:\[\[\w+\]\] )?[A-Za-z_][^;={}()]*?\b(\w+)\s*(?:[({;=\[]|$)', re.M)
ONE_LINE = re.compile(r'^(?:inline |)(?:constexpr|const|static|std::atomic)\b[^\n]*;', re.M)
FURTHER = re.compile(r',\s*(\w+)\s*[={]')
USED = re.compile(r'(?<![\w.:])(?<!->)([A-Za-z_]\w*)(?!\w|::)')


def declared_in(code):
    code = ALIAS.sub('', code)
    names = set(TYPE.findall(code)) | set(OTHER.findall(code))
    for line in ONE_LINE.findall(code):
        names |= set(FURTHER.findall(line))
    return names


@functools.cache
def text_of(path):
    with open(path, encoding='utf-8') as file:
        return file.read()


@functools.cache
def included_by(path, roots):
    """The headers of ours that `path` names itself."""
    found = [os.path.join(root, name) for name in INCLUDE.findall(text_of(path)) for root in roots]
    return [name for name in found if os.path.isfile(name)]


@functools.cache
def declared_by_header(path):
    return declared_in(NO_CODE.sub('""', text_of(path)))


def headers_of(path, roots):
    """All headers of ours that the compiler reads for `path`."""
    seen, left = set(), [path]
    while left:
        more = [header for header in included_by(left.pop(), roots) if header not in seen]
        seen.update(more)
        left += more
    return seen


def names_of(path, roots):
    """The names in the file's unnamed namespaces, and the names from headers that it uses."""
    own = set()
    for block in UNNAMED.findall(text_of(path)):
        own |= declared_in(NO_CODE.sub('""', block))
    from_headers = set().union(*map(declared_by_header, headers_of(path, roots)))
    used = set(USED.findall(NO_CODE.sub('""', text_of(path))))
    return own, used & from_headers


def groups_of(paths, most_files, roots):
    groups = []
    for path in paths:
        own, used = names_of(path, roots)
        for group in groups:
            if len(group['paths']) < most_files and not (own & (group['own'] | group['used']) or used & group['own']):
                break
        else:
            group = {'paths': [], 'own': set(), 'used': set()}
            groups.append(group)
        group['paths'].append(path)
        group['own'] |= own
        group['used'] |= used
    return [group['paths'] for group in groups]


def write_if_other(path, text):
    """What has not changed is not compiled again."""
    if not os.path.isfile(path) or text_of(path) != text:
        with open(path, 'w', encoding='utf-8') as file:
            file.write(text)


def compiled_as(group, name, folder):
    """The file to compile for a group: one by itself needs no other."""
    if len(group) == 1:
        return os.path.abspath(group[0])
    path = os.path.abspath(os.path.join(folder, name))
    includes = [os.path.relpath(source, os.path.dirname(path)) for source in group]
    write_if_other(path, ''.join(f'#include "{include}"\n' for include in includes))
    return path


def main():
    folder, most_files, roots = sys.argv[1], int(sys.argv[2]), tuple(sys.argv[3:])
    added = []
    for line in text_of(os.path.join(folder, 'lists')).splitlines():
        target, *sources = line.split(';')
        files = [compiled_as(group, f'{target}_{number}.cpp', folder)
                 for number, group in enumerate(groups_of(sources, most_files, roots))]
        added.append(f'target_sources({target} PRIVATE "' + '" "'.join(files) + '")\n')
    write_if_other(os.path.join(folder, 'groups.cmake'), ''.join(added))


if __name__ == '__main__':
    main()
