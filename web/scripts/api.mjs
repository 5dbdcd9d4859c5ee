// Writes src/api.ts from the service's own OpenAPI document; with --check it only compares (exit 1 on drift).
// SEED_OPENAPI names a file to read instead of asking the service's command line.
import { execFileSync } from "node:child_process";
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import openapiTS, { astToString } from "openapi-typescript";

const web = join(dirname(fileURLToPath(import.meta.url)), "..");
const target = join(web, "src", "api.ts");

function document() {
  if (process.env.SEED_OPENAPI) return readFileSync(process.env.SEED_OPENAPI, "utf8");
  const local = join(web, "..", ".venv", "bin", "seed");
  return execFileSync(existsSync(local) ? local : "seed", ["openapi"], {
    cwd: join(web, ".."),
    encoding: "utf8",
    maxBuffer: 32 * 1024 * 1024,
  });
}

const header =
  "// Generated from the service's OpenAPI document by `npm run api`; `npm run check` fails where they differ.\n\n";
const generated = header + astToString(await openapiTS(JSON.parse(document())));

if (process.argv.includes("--check")) {
  if (!existsSync(target) || readFileSync(target, "utf8") !== generated) {
    console.error(
      "web/src/api.ts differs from the service's OpenAPI document: run `npm run api` and commit it.",
    );
    process.exit(1);
  }
  console.log("web/src/api.ts matches the service's OpenAPI document.");
} else {
  writeFileSync(target, generated);
  console.log("wrote web/src/api.ts");
}
