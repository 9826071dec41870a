/** What an element of this page holds as base64: the page itself carries its session (session/export/review_file.cpp). */
export function bytesOfElement(id: string): Uint8Array<ArrayBuffer> {
  const text = document.getElementById(id)?.textContent ?? '';
  if (text === '') throw new Error(`the page has no ${id}`);
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}
