// Talks to the server, and does not give up: what could not be sent is sent again until the server has it.

const LONGEST_PAUSE = 15_000;
const PATIENCE = 20_000;

const pause = (duration) => new Promise((resolve) => setTimeout(resolve, duration));

/** What the server refused: `status` and a sentence. */
export class Refused extends Error {
  constructor(status, sentence) {
    super(sentence);
    this.status = status;
  }
}

/** A place for what has to survive a reload; memory alone where the browser has none. */
export function memory(key) {
  let value = {};
  try {
    value = JSON.parse(localStorage.getItem(key) ?? "{}") ?? {};
  } catch { /* nothing usable is stored */ }
  return {
    get: (name) => value[name],
    set(changes) {
      value = { ...value, ...changes };
      try {
        localStorage.setItem(key, JSON.stringify(value));
      } catch { /* a reload begins again */ }
    },
  };
}

/**
 * A connection. `trouble` is called with a sentence while the server cannot be reached, and with null once it can. `token` tells who one is.
 */
export function connection(base, { token, trouble }) {
  async function once(path, body) {
    const headers = { accept: "application/json" };
    if (token()) headers.authorization = `Bearer ${token()}`;
    if (body !== undefined) headers["content-type"] = "application/json";
    const response = await fetch(`${base}${path}`, {
      method: body === undefined ? "GET" : "POST", headers, body: body === undefined ? undefined : JSON.stringify(body),
      cache: "no-store", signal: AbortSignal.timeout(PATIENCE),
    });
    const answered = await response.json().catch(() => null);
    if (response.ok && answered) return answered;
    if (response.status === 429 || response.status >= 500 || response.ok) throw new Error(`status ${response.status}`);
    throw new Refused(response.status, answered?.error ?? `the server answered with status ${response.status}`);
  }

  /** Asks until there is an answer. Whatever is sent may arrive twice. */
  return async function ask(path, body) {
    for (let wait = 1000; ; wait = Math.min(2 * wait, LONGEST_PAUSE)) {
      try {
        const answered = await once(path, body);
        trouble(null);
        return answered;
      } catch (error) {
        if (error instanceof Refused) {
          trouble(null);
          throw error;
        }
        trouble("The server cannot be reached. Nothing is lost: your answer is kept and sent again by itself. Please keep this page open.");
        await pause(wait);
      }
    }
  };
}
