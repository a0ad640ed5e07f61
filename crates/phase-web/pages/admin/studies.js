// The studies of this server, for the person in charge: how far they are, and downloads.
import { ask, button, save, table } from "./admin.js";

const section = document.createElement("section");
section.setAttribute("aria-label", "Studies");
section.hidden = true;
const title = Object.assign(document.createElement("h2"), { textContent: "Studies" });
const place = document.createElement("div");
section.append(title, place);
document.getElementById("more").append(section);

const FILES = [["psych-ds.tar", "Psych-DS"], ["ratings.json", "Ratings"], ["report.html", "Report"], ["analysis.json", "Analysis"]];

function row({ name, form, title: text, raters, wanted, coverage, raters_per_video: each }) {
  const link = Object.assign(document.createElement("a"), { href: `../study/${encodeURIComponent(name)}/`, textContent: text });
  const downloads = document.createElement("span");
  for (const [file, label] of FILES) {
    // Interactions are no relations.
    if (file === "ratings.json" && form === "interactions") continue;
    const made = button(label, () => save(`api/studies/${encodeURIComponent(name)}/${file}`, `${name}-${file}`));
    made.setAttribute("aria-label", `${label} of ${name}`);
    downloads.append(made, " ");
  }
  return [
    link, `${raters.complete} of ${wanted}`, String(raters.unfinished), String(raters.failed), `${raters.withdrawn}, ${raters.declined}`,
    `${coverage.least} to ${coverage.most} of ${each}`, downloads,
  ];
}

async function refresh() {
  if (document.getElementById("inside").hidden) return;
  const answer = await ask("api/studies");
  if (!answer) return;
  const { studies } = await answer.json();
  section.hidden = studies.length === 0;
  const head = ["study", "complete", "unfinished", "failed catch trials", "withdrawn, declined", "raters of a video", "files"];
  // A button that has the focus keeps it: nothing is replaced that is the same.
  const rows = JSON.stringify(studies);
  if (place.dataset.rows === rows) return;
  place.dataset.rows = rows;
  place.replaceChildren(table(head, studies.map(row)));
}

setInterval(refresh, 2000);
new MutationObserver(refresh).observe(document.getElementById("inside"), { attributes: true, attributeFilter: ["hidden"] });
