/** Colours that stay apart for colour-blind eyes (Okabe and Ito 2008), red, green, blue. */
export const partColours: readonly (readonly [number, number, number])[] = [
  [0, 0, 0],
  [230, 159, 0],
  [86, 180, 233],
  [0, 158, 115],
  [204, 121, 167],
];
export const previewColour = [240, 228, 66] as const;

export const cssColour = (label: number): string => `rgb(${(partColours[label] ?? partColours[0] ?? []).join(' ')})`;
