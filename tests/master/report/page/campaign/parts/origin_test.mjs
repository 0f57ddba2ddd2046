import assert from "node:assert/strict";
import test from "node:test";
import { whereText } from "../../../../../../master/report/page/src/campaign/parts/origin.js";

test("it says where cases have run, and when they began", () => {
  const began = ["2026-11-25T23:59:59Z", "2026-11-26T00:10:00Z"];
  const hosts = [
    { name: "a", cases: 1 },
    { name: "b", cases: 1200 },
  ];
  assert.equal(
    whereText({ began, hosts }),
    "1 case on a, 1,200 cases on b, which began from 2026-11-25T23:59:59Z to 2026-11-26T00:10:00Z",
  );
  assert.equal(whereText({ began: [began[0], began[0]], hosts: hosts.slice(0, 1) }), `1 case on a, which began at ${began[0]}`);
  assert.equal(whereText({ began: ["", ""], hosts: [] }), "");
});
