/** Beside the map: the gallery, the situation in numbers, its plan, and what to do with it. */

import { Alternatives } from "../panels/alternatives";
import { PlanNumbers } from "../panels/plan";
import type { Actions, Session } from "../session";
import { SituationForm } from "./form";
import { Gallery } from "./gallery-panel";
import { OthersForm } from "./others-form";
import { Remedies } from "./remedies";
import { TakeAlong } from "./take-along";
import { twoTimes } from "./two-times";
import "./bench.css";

export function MapBench({ session, actions }: { session: Session; actions: Actions }) {
  const { map } = session;
  return (
    <section
      class={`workstation map-bench ${map.isLate.value ? "is-late" : ""}`}
      aria-label="Situation and plan"
    >
      <Gallery session={session} />
      <div class="panels">
        <div class="column">
          <SituationForm map={map} />
        </div>
        <div class="column numbers">
          <Remedies map={map} />
          <PlanNumbers session={map.reading} {...twoTimes(map.reading.answered.value)} />
        </div>
        <div class="column lists">
          <TakeAlong session={session} actions={actions} />
          <OthersForm map={map} />
          <Alternatives session={map.reading} />
        </div>
      </div>
    </section>
  );
}
