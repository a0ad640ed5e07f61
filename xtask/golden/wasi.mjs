// Runs a WebAssembly program for `cargo xtask golden --machine wasm`: it sees the files of the workspace under the same paths.
import { readFile } from "node:fs/promises";
import { dirname } from "node:path";
import { argv, env, exit } from "node:process";
import { fileURLToPath } from "node:url";
import { WASI } from "node:wasi";

const [program, ...words] = argv.slice(2);
const root = dirname(dirname(fileURLToPath(import.meta.url)));
const wasi = new WASI({ version: "preview1", args: [program, ...words], env, preopens: { [root]: root } });
const module = await WebAssembly.compile(await readFile(program));
const instance = await WebAssembly.instantiate(module, wasi.getImportObject());
exit(wasi.start(instance) ?? 0);
