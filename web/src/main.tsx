/** Puts the cockpit together: store, stream, page, and what draws the picture again and again. */

import "@fontsource/b612/latin-400.css";
import "@fontsource/b612/latin-700.css";
import "./styles/tokens.css";
import "./styles/palette.css";
import "./styles/base.css";
import "./styles/layout.css";
import "./styles/panels.css";
import "./styles/controls.css";
import "./styles/convergence.css";
import "./styles/aircraft.css";
import "./styles/alternatives.css";
import "./styles/events.css";
import "./styles/small.css";
import "./nd/nd.css";
import { effect } from "@preact/signals";
import { render } from "preact";
import { createActions } from "./actions";
import { followRange } from "./auto-range";
import { Cockpit } from "./cockpit";
import { followFirstStart } from "./first-start";
import { isTaken, keyAction, stepAction } from "./keyboard";
import { drawPictures } from "./pace";
import { followPlanners } from "./planners";
import { keepChoices } from "./preferences";
import { createSession } from "./session";
import { createFlightStore } from "./store/flight";
import { followInstant } from "./timeline/link";

const store = createFlightStore();
const session = createSession(store.flight, followFirstStart(), store.history);
const receive = drawPictures(store, session);
const actions = createActions(session, { ...store, receive });
const { letterKeys, sound, distinctColours, captions, pfdOpen } = session;
keepChoices("relguide", { letterKeys, sound, distinctColours, captions, pfdOpen });
effect(() => {
  document.documentElement.dataset.palette = distinctColours.value ? "distinct" : "usual";
});
void import("./afterwards").then(({ beginAfterwards }) => beginAfterwards(session, actions));
followRange(session);
followInstant(session);
followPlanners(session.planners, store.flight);

const place = document.querySelector("#cockpit");
if (place === null) throw new Error("The page has no place for the cockpit.");
render(<Cockpit session={session} actions={actions} />, place);

addEventListener("keydown", (event) => {
  const act =
    stepAction(event, session) ??
    (isTaken(event) ? null : keyAction(event.key, session, actions, event.shiftKey));
  if (act === null) return;
  event.preventDefault();
  act();
});

const open = () => void actions.open(new URL(location.href).searchParams);
addEventListener("popstate", open);
open();
