import type { Signal } from '@preact/signals';
import type { ComponentChildren } from 'preact';

import type { ViewName } from '../../scene/orbit_camera';
import type { BoneScene } from '../../scene/scene';
import type { ViewSettings } from '../../state/view_settings';
import { appText } from '../../text/app_text';
import { HeadsetButton } from './headset_button';
import { SceneTools } from './scene_tools';

const views: readonly (readonly [ViewName, string])[] = [
  ['plan', appText.viewPlan],
  ['axis', appText.viewAxis],
  ['side', appText.viewSide],
];

interface Parts {
  scene: Pick<BoneScene, 'look' | 'headset' | 'enterHeadset' | 'quality'>;
  view: ViewSettings;
  reamerShown: Signal<boolean>;
  children?: ComponentChildren;
}

/** From where the picture is seen and what it shows. */
export function ViewTools({ scene, view, reamerShown, children }: Parts) {
  return (
    <div class="views" role="group" aria-label={appText.view}>
      {views.map(([name, label]) => (
        <button
          type="button"
          key={name}
          data-testid={`view-${name}`}
          title={appText.viewHint[name]}
          onClick={() => {
            view.change({ camera: 'own' });
            scene.look(name);
          }}
        >
          {label}
        </button>
      ))}
      <SceneTools view={view} level={scene.quality.level} />
      {children}
      <HeadsetButton headset={scene.headset} putOn={() => scene.enterHeadset()} />
      <ReamerChoice shown={reamerShown} />
    </div>
  );
}

function ReamerChoice({ shown }: { shown: Signal<boolean> }) {
  return (
    <label>
      <input
        type="checkbox"
        data-testid="show-reamer"
        checked={shown.value}
        onChange={(event) => (shown.value = event.currentTarget.checked)}
      />
      {appText.showReamer}
    </label>
  );
}
