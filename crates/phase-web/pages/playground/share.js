// A scene and its settings in the fragment of an address: JSON, deflated, in base64url.

async function through(stream, bytes) {
  const answer = new Response(new Blob([bytes]).stream().pipeThrough(stream));
  return new Uint8Array(await answer.arrayBuffer());
}

/** The fragment that stands for a value. */
export async function fragment(value) {
  const bytes = await through(new CompressionStream("deflate-raw"), new TextEncoder().encode(JSON.stringify(value)));
  const text = btoa(String.fromCharCode(...bytes));
  return "#" + text.replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}

// A scene has a few kilobytes; what unpacks to more is none.
const LIMIT = 100_000;

/** The value that a fragment stands for; null if it stands for none. */
export async function value(fragment) {
  if (fragment.length < 2 || fragment.length > LIMIT) return null;
  try {
    const text = atob(fragment.slice(1).replaceAll("-", "+").replaceAll("_", "/"));
    const packed = Uint8Array.from(text, (character) => character.charCodeAt(0));
    const bytes = await through(new DecompressionStream("deflate-raw"), packed);
    return bytes.length > LIMIT ? null : JSON.parse(new TextDecoder().decode(bytes));
  } catch {
    return null;
  }
}
