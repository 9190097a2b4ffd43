/** Parts of the page that are fetched when they are first shown: the first load stays small. */

import type { ComponentType } from "preact";
import { useEffect, useState } from "preact/hooks";

/** A component that is fetched when it is first drawn; until then `while` says so. */
export function late<P extends object>(
  fetchIt: () => Promise<ComponentType<P>>,
  meanwhile: string,
): ComponentType<P> {
  let fetched: ComponentType<P> | null = null;
  return function Late(props: P) {
    const [, draw] = useState(0);
    useEffect(() => {
      if (fetched !== null) return;
      let isShown = true;
      void fetchIt().then((part) => {
        fetched = part;
        if (isShown) draw(1);
      });
      return () => {
        isShown = false;
      };
    }, []);
    const Part = fetched;
    return Part === null ? <p role="status">{meanwhile}</p> : <Part {...props} />;
  };
}
