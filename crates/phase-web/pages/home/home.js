// The studies of this server, if it has any.
const answer = await fetch("api/studies").catch(() => null);
const { studies = [] } = answer?.ok ? await answer.json() : {};
for (const { name, title } of studies) {
  const link = Object.assign(document.createElement("a"), { href: `study/${encodeURIComponent(name)}/`, textContent: title });
  const item = document.createElement("li");
  item.append(link);
  document.getElementById("studies").append(item);
}
document.getElementById("rate").hidden = studies.length === 0;
