/** The page: the ND, the 3D scene, and the panels round them. */

import { type Signal, useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { late } from "./late";
import { NavigationDisplay } from "./nd/nd";
import { Aircraft } from "./panels/aircraft";
import { Alternatives } from "./panels/alternatives";
import { Captioned } from "./panels/caption";
import { Efis } from "./panels/efis";
import { Engage } from "./panels/engage";
import { Announcer, Events } from "./panels/events";
import { FirstStart } from "./panels/first-start";
import { FlightControls } from "./panels/flight-controls";
import { Header } from "./panels/header";
import { LeaderControls } from "./panels/leader-controls";
import { OutageNotice } from "./panels/outage";
import { PlanNumbers } from "./panels/plan";
import { ScenarioPicker } from "./panels/scenario-picker";
import { set } from "./parts";
import type { Actions, Session } from "./session";
import { Timeline } from "./timeline/timeline";

/** Where the panels stand in two columns instead of three: as in styles/layout.css. */
const NARROW = "(max-width: 1279px)";
/** Where all stand in one column. */
const SMALL = "(max-width: 999px)";

const MapBench = late(async () => (await import("./map/bench")).MapBench, "The map is on its way.");
const PlanMap = late(async () => (await import("./map/map")).PlanMap, "The map is on its way.");
const UnderMap = late(async () => (await import("./map/under-map")).UnderMap, "");
const PlannersPanel = late(
  async () => (await import("./panels/planners")).PlannersPanel,
  "The planners are on their way.",
);
const TrafficPanel = late(async () => (await import("./panels/traffic")).Traffic, "");
const Scene = late(async () => (await import("./scene/scene")).Scene, "The scene is on its way.");
const Pfd = late(async () => (await import("./pfd/pfd")).PrimaryFlightDisplay, "");
const Help = late(async () => (await import("./panels/help")).Help, "");
const Charts = late(
  async () => (await import("./charts/charts")).Charts,
  "The charts are on their way.",
);
const Debrief = late(async () => (await import("./debrief/debrief")).Debrief, "");
const ComparePanel = late(async () => (await import("./compare/panel")).ComparePanel, "");
const ExportDialog = late(async () => (await import("./panels/export-dialog")).ExportDialog, "");
const Captions = late(async () => (await import("./panels/captions")).Captions, "");
const StickPad = late(async () => (await import("./hands/pad")).StickPad, "");
const Records = late(async () => (await import("./panels/records")).Records, "");

export function Cockpit(props: { session: Session; actions: Actions }) {
  const { session, actions } = props;
  const narrow = useMedia(NARROW);
  const small = useMedia(SMALL);
  const isMap = session.ndMode.value === "PLAN";
  const isByHand = session.shown.numbers.value.sample?.autopilot === false;
  const isFlown = session.pfdOpen.value || isByHand;
  const pfd = isFlown && !isMap && <Pfd session={session} />;
  return (
    <>
      <Header session={session}>
        <ScenarioPicker session={session} actions={actions} />
        <FirstStart readiness={session.firstStart} />
      </Header>
      <main class={session.sceneMaximised.value ? "maximised" : ""}>
        <section class="instrument" aria-label="Navigation display and its controls">
          <Efis session={session} />
          <div class="bezel">
            <Captioned>
              {isMap ? (
                <PlanMap map={session.map} />
              ) : (
                <NavigationDisplay
                  shown={session.shown}
                  mode={session.ndMode}
                  range={session.ndRange}
                  designate={() => actions.engage("designated")}
                />
              )}
            </Captioned>
          </div>
          {small.value && pfd}
          {!isMap && <Captions {...props} />}
          <div class="below">
            {small.value && !isMap && <Engage session={session} actions={actions} />}
            {isMap ? (
              <UnderMap session={session} actions={actions} isSmall={small.value} />
            ) : (
              <Events session={session} />
            )}
            {narrow.value && !isMap && <Aircraft session={session} actions={actions} />}
          </div>
        </section>
        {isMap ? (
          <MapBench session={session} actions={actions} />
        ) : (
          <section class="workstation" aria-label="Scene and panels">
            <div class="beside">
              {!small.value && pfd}
              {session.debriefOpen.value ? (
                <Debrief {...props} />
              ) : session.chartsOpen.value ? (
                <Charts session={session} actions={actions} />
              ) : (
                !(isFlown && narrow.value) &&
                session.hands.value?.isSlow.value !== true && (
                  <Scene session={session} actions={actions} />
                )
              )}
              <OutageNotice session={session} actions={actions} />
            </div>
            <div class="panels">
              {session.comparison.other.value !== null && (
                <div class="column comparing">
                  <ComparePanel session={session} actions={actions} />
                </div>
              )}
              <div class="column commands">
                <FlightControls session={session} actions={actions} />
                <LeaderControls
                  key={session.status.value?.id}
                  session={session}
                  actions={actions}
                />
                {narrow.value && <About session={session} />}
              </div>
              <div class="column numbers">
                {!small.value && <Engage session={session} actions={actions} />}
                <PlanNumbers session={session} />
                {narrow.value && <Others session={session} />}
              </div>
              {!narrow.value && (
                <div class="column lists">
                  <Aircraft session={session} actions={actions} />
                  <About session={session} />
                  <Others session={session} />
                </div>
              )}
            </div>
          </section>
        )}
      </main>
      {session.hands.value !== null && <StickPad session={session} actions={actions} />}
      {!isMap && <Timeline session={session} actions={actions} />}
      {session.helpOpen.value && <Help {...props} />}
      {session.exportOpen.value && <ExportDialog session={session} />}
      {session.recordsOpen.value && <Records session={session} actions={actions} />}
      <Announcer session={session} />
    </>
  );
}

/** Traffic and weather, where the flight has any. */
function About({ session }: { session: Session }) {
  const started = session.flight.read.value.started;
  if (started === null || started.others.length + started.cells.length === 0) return null;
  return <TrafficPanel session={session} />;
}

/** The other paths of the planner that flies, or what other planners would fly. */
function Others({ session }: { session: Session }) {
  const { isOpen } = session.planners;
  return isOpen.value ? (
    <PlannersPanel session={session} />
  ) : (
    <Alternatives session={session} compare={set(isOpen, true)} />
  );
}

/** Whether a media query holds, now and whenever that changes. */
function useMedia(query: string): Signal<boolean> {
  const holds = useSignal(matchMedia(query).matches);
  useEffect(() => {
    const media = matchMedia(query);
    const note = () => {
      holds.value = media.matches;
    };
    media.addEventListener("change", note);
    return () => media.removeEventListener("change", note);
  }, [query, holds]);
  return holds;
}
