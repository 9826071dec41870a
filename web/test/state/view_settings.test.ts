import { describe, expect, it } from 'vitest';

import { plainView, theatreView, viewFromText, ViewSettings } from '../../src/state/view_settings';

function storage(kept: Record<string, string> = {}) {
  return {
    kept,
    getItem: (key: string) => kept[key] ?? null,
    setItem: (key: string, value: string) => void (kept[key] = value),
  };
}

describe('what the picture shows', () => {
  it('is kept for each person apart', () => {
    const disk = storage();
    const view = new ViewSettings();
    const end = view.keepFor('anna', disk);
    view.change({ cutAway: true, opacity: 0.25 });
    view.changeSection('coronal', { on: true, offsetMm: 7.5 });
    end();
    const endTom = view.keepFor('tom', disk);
    expect(view.choices.value).toEqual(plainView);
    view.change({ camera: 'trainee' });
    endTom();
    view.keepFor('anna', disk);
    expect(view.choices.value.cutAway).toBe(true);
    expect(view.choices.value.camera).toBe('own');
    expect(view.choices.value.sections.coronal).toEqual({ on: true, offsetMm: 7.5, flipped: false });
  });

  it('is plain where what was kept cannot be understood', () => {
    for (const text of [null, '', 'x{', '[]', '3', 'null', '{"opacity":"x","sections":{"axial":5}}'])
      expect(viewFromText(text)).toEqual(plainView);
    const odd = viewFromText('{"opacity":-3,"sections":{"axial":{"on":true,"offsetMm":1e9}}}');
    expect(odd.opacity).toBe(0.1);
    expect(odd.sections.axial.offsetMm).toBe(40);
  });

  it('is seen from one’s own camera for a while without that being kept', () => {
    const disk = storage();
    const view = new ViewSettings();
    view.keepFor('anna', disk);
    view.change({ camera: 'trainee' });
    view.ownForNow.value = true;
    expect([view.camera.value, view.shown.value.camera]).toEqual(['own', 'own']);
    expect(viewFromText(disk.kept['ream.view.anna'] ?? null).camera).toBe('trainee');
    view.change({ camera: 'trainee' });
    expect(view.shown.value.camera).toBe('trainee');
    view.ownForNow.value = true;
    view.ownForNow.value = false;
    expect(view.shown.value.camera).toBe('trainee');
  });

  it('lets no section leave its reach', () => {
    const view = new ViewSettings();
    view.changeSection('axial', { offsetMm: 41 });
    expect(view.choices.value.sections.axial.offsetMm).toBe(40);
    view.changeSection('axial', { offsetMm: -77 });
    expect(view.choices.value.sections.axial.offsetMm).toBe(-40);
  });

  it('is the surgeon’s in theatre, whatever was chosen, and the chosen again afterwards', () => {
    const view = new ViewSettings();
    view.change({ cutAway: true, seeThrough: true });
    view.theatre.value = true;
    expect(view.shown.value).toEqual(theatreView);
    view.change({ cutAway: true });
    expect(view.shown.value.cutAway).toBe(false);
    view.theatre.value = false;
    expect(view.shown.value.cutAway).toBe(true);
  });

  it('keeps how the reamer is drawn, also in theatre', () => {
    const disk = storage();
    const view = new ViewSettings();
    view.keepFor('anna', disk)();
    expect(view.shown.value.toolDrawing).toBe('automatic');
    view.change({ toolDrawing: 'plain' });
    view.theatre.value = true;
    expect(view.shown.value).toEqual({ ...theatreView, toolDrawing: 'plain' });
    expect(viewFromText('{"toolDrawing":"full"}').toolDrawing).toBe('full');
    expect(viewFromText('{"toolDrawing":"gold"}').toolDrawing).toBe('automatic');
  });

  it('goes on without a place to keep anything', () => {
    const view = new ViewSettings();
    const setItem = () => {
      throw new Error('full');
    };
    const full = { ...storage(), setItem };
    view.keepFor('anna', full);
    view.change({ cutAway: true });
    expect(view.shown.value.cutAway).toBe(true);
  });
});
