// Bundles the forms and the plugins: dist/index.js, a module that imports jsPsych, and dist/index.browser.js, a script for pages without a bundler.
import { build } from "esbuild";

// In pages without a bundler jsPsych is a global.
const asGlobal = {
  name: "jspsych-as-global",
  setup(made) {
    made.onResolve({ filter: /^jspsych$/ }, () => ({ path: "jspsych", namespace: "global" }));
    made.onLoad({ filter: /.*/, namespace: "global" }, () => ({ contents: "export const ParameterType = jsPsychModule.ParameterType;" }));
  },
};

// The forms first, for the plugins include their bundle. What they ask and how it is shown lies outside of the package.
await build({ entryPoints: ["packages/forms/src/index.js"], outfile: "packages/forms/dist/index.js", bundle: true, format: "esm", logLevel: "warning" });

for (const [name, global] of [["plugin-phase-video", "jsPsychPhaseVideo"], ["plugin-phase-rating", "jsPsychPhaseRating"]]) {
  const [entry, out] = [`packages/${name}/src/index.js`, `packages/${name}/dist`];
  await build({ entryPoints: [entry], outfile: `${out}/index.js`, bundle: true, format: "esm", external: ["jspsych"], logLevel: "warning" });
  await build({
    entryPoints: [entry], outfile: `${out}/index.browser.js`, bundle: true, format: "iife", globalName: `${global}Module`, plugins: [asGlobal],
    footer: { js: `var ${global} = ${global}Module.default;` }, logLevel: "warning",
  });
}
