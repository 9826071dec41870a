import { crc32 } from 'node:zlib';

export interface ZipEntry {
  name: string;
  bytes: Buffer;
}

const localHead = 30;
const listHead = 46;
const endHead = 22;

/** A ZIP of files as they are, not compressed. */
export function zipOf(entries: readonly ZipEntry[]): Buffer {
  const parts: Buffer[] = [];
  const list: Buffer[] = [];
  let at = 0;
  for (const { name, bytes } of entries) {
    const text = Buffer.from(name);
    const shared = Buffer.alloc(26);
    shared.writeUInt16LE(20, 0);
    shared.writeUInt32LE(crc32(bytes), 10);
    shared.writeUInt32LE(bytes.length, 14);
    shared.writeUInt32LE(bytes.length, 18);
    shared.writeUInt16LE(text.length, 22);
    const local = Buffer.alloc(localHead);
    local.writeUInt32LE(0x04034b50, 0);
    shared.copy(local, 4);
    const listed = Buffer.alloc(listHead);
    listed.writeUInt32LE(0x02014b50, 0);
    listed.writeUInt16LE(20, 4);
    shared.copy(listed, 6);
    listed.writeUInt32LE(at, 42);
    parts.push(local, text, bytes);
    list.push(listed, text);
    at += localHead + text.length + bytes.length;
  }
  const listBytes = list.reduce((sum, part) => sum + part.length, 0);
  const end = Buffer.alloc(endHead);
  end.writeUInt32LE(0x06054b50, 0);
  end.writeUInt16LE(entries.length, 8);
  end.writeUInt16LE(entries.length, 10);
  end.writeUInt32LE(listBytes, 12);
  end.writeUInt32LE(at, 16);
  return Buffer.concat([...parts, ...list, end]);
}
