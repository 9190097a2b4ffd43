/** Learn to fly it: the three lessons, and how well each was flown. */

import type { Actions, Session } from "../session";
import { best, clearBest } from "./best";
import { LESSONS, sayLate } from "./lessons";
import "./lessons.css";

export function LessonList({ session, actions }: { session: Session; actions: Actions }) {
  const times = best.value;
  return (
    <section class="lesson-list" aria-labelledby="lessons-title">
      <h2 id="lessons-title">Learn to fly it</h2>
      <ol>
        {LESSONS.map(({ scenario, title }) => {
          const late = times[scenario];
          return (
            <li key={scenario}>
              <button
                type="button"
                onClick={() => {
                  session.helpOpen.value = false;
                  actions.start(scenario);
                }}
              >
                {title}
              </button>
              <span>{late === undefined ? "not flown yet" : `best: ${sayLate(late)}`}</span>
            </li>
          );
        })}
      </ol>
      <p>
        Four minutes each, by hand: arrow keys, a controller, or a finger. Best times stay in this
        browser.
        {Object.keys(times).length > 0 && (
          <button type="button" class="quiet" onClick={clearBest}>
            Clear best times
          </button>
        )}
      </p>
    </section>
  );
}
