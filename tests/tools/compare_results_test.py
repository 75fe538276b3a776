# SPDX-License-Identifier: BSL-1.0
"""compare_results.py finds a changed digit, row, label or verdict in copies of the real results."""

import json
import re
import shutil
import unittest

from tree import TOOLS, TreeTest

RESULTS = TOOLS.parent / "docs/results"


class Results(TreeTest):
    def setUp(self):
        super().setUp()
        for page in ("chapter3", "chapter4"):
            shutil.copytree(RESULTS / page, self.root / page)
            shutil.copy(RESULTS / f"{page}.json", self.root)

    def change(self, file, change):
        path = self.root / file
        results = json.loads(path.read_text(encoding="utf-8"))
        change(results)
        path.write_text(json.dumps(results), encoding="utf-8")

    def differences(self):
        status, output = self.run_tool("compare_results.py", RESULTS, self.root)
        lines = output.splitlines()[:-1]
        self.assertEqual(status, 1 if lines else 0)
        return lines

    def test_copies_are_equal(self):
        self.assertEqual(self.differences(), [])

    def test_a_digit_of_a_number(self):
        def change(results):
            results["benchmarks"][3]["gamma"] *= 1 + 1e-8
        self.change("chapter3/fig_3_5.json", change)
        found = self.differences()
        self.assertEqual(len(found), 1)
        self.assertRegex(found[0], r"^chapter3/fig_3_5.json: benchmarks: .*: gamma: ")

    def test_rounding_and_times_and_the_machine(self):
        def change(results):
            row = results["benchmarks"][3]
            row["gamma"] *= 1 + 1e-12
            row["p50_deg"] += 1e-12
            for key in ("real_time", "us", "us_with_search", "pi_1us"):
                row[key] *= 2
            results["context"]["num_cpus"] = 64
            results["benchmarks"].reverse()
        self.change("chapter3/fig_3_5.json", change)
        self.assertEqual(self.differences(), [])

    def test_a_count_a_label_and_a_verdict(self):
        def change(results):
            rows = results["tables"]["rows"]
            rows[0]["n_m"] += 1
            rows[1]["data set"] = "Dining Room R"
            rows[2]["changed by a second run"] = True
            rows[3]["t_nve"] = 3.0
        self.change("chapter4/table_4_1.json", change)
        self.assertEqual(len(self.differences()), 3)

    def test_a_row_or_a_key_more_or_less(self):
        def change(results):
            del results["tables"]["rows"][-1]
            results["tables"]["rows"][0]["more"] = 1
        self.change("chapter4/table_4_1.json", change)
        self.assertEqual(len(self.differences()), 2)

    def test_a_quick_run_is_another(self):
        def change(results):
            results["context"]["quick"] = True
        self.change("chapter4/table_4_1.json", change)
        self.assertEqual(len(self.differences()), 1)

    def test_a_file_that_is_missing(self):
        (self.root / "chapter4/fig_4_2.json").unlink()
        self.assertEqual(len(self.differences()), 1)

    def test_old_names_and_new_ones(self):
        def change(results):
            for row in results["tables"]["surfaces"]:
                row["initial segments"] = row.pop("fragments", None) or row["initial segments"]
        self.change("chapter4/fig_4_9.json", change)
        self.assertEqual(self.differences(), [])

    def test_relations(self):
        def reword(results):
            for relation in results["relations"]:
                relation["claim"] = re.sub(r"[a-z]{4,}", "word", relation["claim"])
                relation["measured"] = re.sub(r"[a-z]{4,}", "word", relation["measured"])
        self.change("chapter4.json", reword)
        self.assertEqual(self.differences(), [])

        def change(results):
            by_id = {relation["id"]: relation for relation in results["relations"]}
            by_id["4.9.1"]["holds"] = not by_id["4.9.1"]["holds"]
            by_id["4.p.1"]["measured"] = by_id["4.p.1"]["measured"].replace("0.9", "0.8", 1)
            by_id["4.p.1"]["claim"] = by_id["4.p.1"]["claim"].replace("0.9", "0.8", 1)
            by_id["4.1c"]["measured"] = "40 ms"
        self.change("chapter4.json", change)
        self.assertEqual(len(self.differences()), 3)


if __name__ == "__main__":
    unittest.main()
