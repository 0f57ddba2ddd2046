// validate.mjs FOLDER FILE...: Khronos' validator, which is in the packages of FOLDER, has neither an error nor a
// warning about the files.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { resolve } from "node:path";

const [folder, ...files] = process.argv.slice(2);
const validator = createRequire(resolve(folder, "package.json"))("gltf-validator");
const kWarning = 1;

let bad = 0;
for (const file of files) {
  const { issues, info } = await validator.validateBytes(new Uint8Array(readFileSync(file)), { maxIssues: 0 });
  const told = issues.messages.filter(({ severity }) => severity <= kWarning);
  for (const { code, message, pointer } of told) console.log(`${file}: ${code}: ${message} (${pointer})`);
  console.log(`${file}: ${info.totalVertexCount} vertices, ${info.animationCount} animations, ${told.length} complaints`);
  bad += told.length;
}
process.exit(bad === 0 && files.length > 0 ? 0 : 1);
