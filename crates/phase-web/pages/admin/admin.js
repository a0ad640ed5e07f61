// What only the person in charge sees. The token stays in this page.

const at = (id) => document.getElementById(id);
let token = location.hash.slice(1);
let timer = 0;
// Colours of both agents, as the server says.
let colours = [];

const say = (text, wrong = false) => {
  at("message").textContent = text;
  at("message").classList.toggle("wrong", wrong);
};

/** Asks with the token; null and a message if that fails. */
export async function ask(path, options = {}) {
  const headers = { authorization: `Bearer ${token}` };
  const answer = await fetch(path, { ...options, headers }).catch(() => null);
  if (answer?.ok) return answer;
  const told = await answer?.json().catch(() => null);
  say(told?.error ?? "The server cannot be reached.", true);
  return null;
}

/** A table of texts, numbers and elements. */
export function table(head, rows) {
  const cell = (name) => (content) => {
    const made = document.createElement(name);
    made.append(content);
    return made;
  };
  const row = (name, contents) => {
    const made = document.createElement("tr");
    made.append(...contents.map(cell(name)));
    return made;
  };
  const made = document.createElement("table");
  made.append(row("th", head), ...rows.map((contents) => row("td", contents)));
  return made;
}

export function button(text, act) {
  const made = Object.assign(document.createElement("button"), { type: "button", textContent: text });
  made.addEventListener("click", act);
  return made;
}

/** Offers an answer as a file. */
export async function save(path, name) {
  const answer = await ask(path);
  if (!answer) return;
  const link = Object.assign(document.createElement("a"), { href: URL.createObjectURL(await answer.blob()), download: name });
  link.click();
  URL.revokeObjectURL(link.href);
}

async function refresh() {
  const answer = await ask("api/status");
  if (!answer) return false;
  const { only_studies: onlyStudies, agents, rooms, most_rooms, scenes, recordings } = await answer.json();
  for (const id of ["games", "given", "back"]) at(id).hidden = onlyStudies;
  colours = agents;
  at("count").textContent = `${rooms.length} of at most ${most_rooms} games, ${recordings} recordings.`;
  const trip = (ms) => (ms === null ? "–" : `${ms} ms`);
  at("rooms").replaceChildren(table(
    ["room", "doing", "round", ...agents, "round trip", "end"],
    rooms.map(({ room, doing, round, rounds, connected, round_trip_ms }) => [
      room, doing, `${round} of ${rounds}`, connected[0] ? "here" : "–", connected[1] ? "here" : "–", round_trip_ms.map(trip).join(", "),
      button("End", async () => (await ask(`api/rooms/${encodeURIComponent(room)}`, { method: "DELETE" })) && refresh()),
    ]),
  ));
  at("scenes").replaceChildren(table(["scene", "given"], scenes.map(({ source, given }) => [source, String(given)])));
  return true;
}

async function enter() {
  clearInterval(timer);
  if (!(await refresh())) return;
  say("");
  at("enter").hidden = true;
  at("inside").hidden = false;
  timer = setInterval(refresh, 2000);
}

at("enter").addEventListener("submit", (event) => {
  event.preventDefault();
  token = at("token").value.trim();
  enter();
});

at("open").addEventListener("click", async () => {
  const answer = await ask("../api/rooms", { method: "POST", body: JSON.stringify({ partner: "human", agent: 0 }) });
  if (!answer) return;
  const { room, tokens } = await answer.json();
  const item = document.createElement("li");
  item.append(`Room ${room}: `);
  colours.forEach((name, k) => {
    const href = new URL(`../play/#${tokens[k]}`, location.href).href;
    item.append(Object.assign(document.createElement("a"), { href, textContent: `player ${name}` }), " ");
  });
  at("links").append(item);
  refresh();
});

at("download").addEventListener("click", () => save("api/events.json", "played-events.json"));

if (token) enter();
