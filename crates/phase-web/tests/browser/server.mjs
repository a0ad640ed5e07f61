// A server of this project, started for a test.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { once } from "node:events";

/** Starts `phase serve` with options on a free port; `PHASE` names the program. */
export async function start(...options) {
  const program = process.env.PHASE;
  assert.ok(program, "PHASE names the program");
  const listen = options.includes("--listen") ? [] : ["--listen", "127.0.0.1:0"];
  const child = spawn(program, ["serve", ...listen, ...options], { stdio: ["ignore", "pipe", "inherit"] });
  let said = "";
  while (!said.includes("Ctrl-C")) {
    const [chunk] = await Promise.race([
      once(child.stdout, "data"),
      once(child, "exit").then(([code]) => { throw new Error(`the server ended with ${code}`); }),
    ]);
    said += chunk;
  }
  const [address, token] = said.match(/(http:\S+)\/admin\/#(\w+)/).slice(1);
  const stop = async (signal) => {
    const ended = once(child, "exit");
    child.kill(signal);
    return (await ended)[0];
  };
  return { address: `${address}/`, token, stop };
}

/** What a page and its browser complain of, collected in a list. */
export function listen(page, complaints) {
  page.on("console", (message) => { if (["error", "warning"].includes(message.type())) complaints.push(message.text()); });
  page.on("pageerror", (error) => complaints.push(error.message));
}

/** What axe finds on a page. */
export async function violations(page, axe) {
  await page.evaluate(axe);
  const { violations } = await page.evaluate(() => globalThis.axe.run());
  return violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ html }) => html).join(" ")}`);
}
