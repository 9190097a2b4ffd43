/** Puts the controller's page together: store, stream, page and keys. */

import "@fontsource/b612/latin-400.css";
import "@fontsource/b612/latin-700.css";
import "../styles/tokens.css";
import "../styles/palette.css";
import "../styles/base.css";
import "./styles/page.css";
import "./styles/header.css";
import "./styles/tones.css";
import "./styles/requests.css";
import "./styles/strip.css";
import "./styles/card.css";
import "./styles/timeline.css";
import "./styles/help.css";
import "./map/map.css";
import { render } from "preact";
import { keepChoices } from "../preferences";
import { socketAddress } from "../stream";
import { PROTOCOL } from "../wire";
import { createActions } from "./actions";
import { Announcer, followChanges } from "./announcer";
import { isTaken, keyAct } from "./keys";
import { Page } from "./page";
import { soundDeviations } from "./sounds";
import { createStation } from "./station";

const station = createStation();
const { sound, letterKeys, all } = station;
const address = socketAddress("api/v1/atc/stream", location.href);
const actions = createActions(station, address, PROTOCOL);
const said = followChanges(station.store);
keepChoices("relguide-atc", { sound, letterKeys, all });
soundDeviations(station);

const place = document.querySelector("#atc");
if (place === null) throw new Error("The page has no place for the controller's position.");
render(
  <>
    <Page station={station} actions={actions} />
    <Announcer said={said} />
  </>,
  place,
);

addEventListener("keydown", (event) => {
  const act = isTaken(event) ? null : keyAct(event, station);
  if (act === null) return;
  event.preventDefault();
  act(station);
});
addEventListener("dragover", (event) => {
  if (event.dataTransfer?.types.includes("Files") === true) event.preventDefault();
});
addEventListener("drop", (event) => {
  const [file] = event.dataTransfer?.files ?? [];
  if (file === undefined) return;
  event.preventDefault();
  void actions.openFile(file);
});
setInterval(() => {
  station.wall.value = Date.now();
}, 1000);
actions.follow();
