/** What begins once the page stands: alerts are heard, files can be dropped, debriefs open by themselves. */

import { openDebriefs } from "./debrief/watch";
import type { Actions, Session } from "./session";
import { soundAlerts } from "./sound";
import { takeDroppedFiles } from "./timeline/drop";

export function beginAfterwards(session: Session, actions: Actions): void {
  soundAlerts(session);
  takeDroppedFiles(actions);
  openDebriefs(session, actions);
}
