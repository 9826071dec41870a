/** Which HU are shown from black to white. */
export interface WindowLevel {
  widthHu: number;
  levelHu: number;
}

export const windowPresets = {
  bone: { widthHu: 1800, levelHu: 450 },
  soft: { widthHu: 400, levelHu: 50 },
} satisfies Record<string, WindowLevel>;

export const windowLimits = { widthMin: 20, widthMax: 6000, levelMin: -1500, levelMax: 3500 };

export function limitWindow({ widthHu, levelHu }: WindowLevel): WindowLevel {
  const { widthMin, widthMax, levelMin, levelMax } = windowLimits;
  return {
    widthHu: Math.round(Math.min(Math.max(widthHu, widthMin), widthMax)),
    levelHu: Math.round(Math.min(Math.max(levelHu, levelMin), levelMax)),
  };
}

/** Brightness 0 to 255 of a HU value: linear from level - width / 2 to level + width / 2. */
export function brightness(hu: number, { widthHu, levelHu }: WindowLevel): number {
  const share = (hu - levelHu) / widthHu + 0.5;
  return Math.round(Math.min(Math.max(share, 0), 1) * 255);
}

/** Brightness of every 16-bit HU value; at hu + 32768. */
export function brightnessTable(window: WindowLevel): Uint8Array<ArrayBuffer> {
  const table = new Uint8Array(65536);
  for (let hu = -32768; hu < 32768; ++hu) table[hu + 32768] = brightness(hu, window);
  return table;
}
