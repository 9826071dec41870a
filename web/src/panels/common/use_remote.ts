import { useEffect, useMemo } from 'preact/hooks';

import { Remote } from '../../state/remote';

/** What the server has, asked for when the component is first shown, and only while it is `wanted`. */
export function useRemote<T>(load: () => Promise<T>, wanted = true): Remote<T> {
  const remote = useMemo(() => new Remote(load), []);
  useEffect(() => {
    if (wanted) void remote.read();
  }, [remote, wanted]);
  return remote;
}
