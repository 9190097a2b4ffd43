/** The page: map and CARD on the left, requests and the strip on the right, time along the foot. */

import type { Actions } from "./actions";
import { AlertBanner, AlertList } from "./alert-list";
import { Card } from "./card";
import { Header } from "./header";
import { Help } from "./help";
import { SkyMap } from "./map/map";
import { RequestList } from "./requests";
import type { Station } from "./station";
import { Strip } from "./strip";
import { Timeline } from "./timeline";

export function Page({ station, actions }: { station: Station; actions: Actions }) {
  const isPast = station.store.instant.value !== null || station.file.value !== "";
  return (
    <div class={`atc${isPast ? " past" : ""}`}>
      <Header station={station} actions={actions} />
      <AlertBanner station={station} />
      <main>
        <div class="atc-left">
          <SkyMap station={station} />
          <Card station={station} />
        </div>
        <div class="atc-right">
          <RequestList station={station} />
          <Strip station={station} />
          <AlertList station={station} />
        </div>
      </main>
      <Timeline station={station} />
      {station.helpOpen.value && <Help station={station} />}
    </div>
  );
}
