"""names_self_test.py ROOT: names_test.py accepts docs/stepping.md and refuses it with each of these mistakes in it."""

import copy
import pathlib
import re
import sys
import unittest

import declarations
import names_test

ROOT = pathlib.Path(sys.argv.pop(1))

# (text of the page, what it becomes, what is reported)
MISTAKES = [
    ("IdleScheduler::suspend_idle(", "EventHandler::suspend_idle(", "EventHandler has no function suspend_idle()"),
    ("Stepper::undo(time)", "Simulation::undo(time)", "Simulation has no function undo()"),
    ("OrderedEvaluation::run", "OrderedEvaluation::execute", "execute() is not a function of master/engine"),
    ("step_stage(", "step_part(", "step_part() is not a function of master/engine"),
    ("check_minimum()", "check_least()", "Stepper::check_minimum() is neither in the pseudocode nor in the list"),
    ("prepare_events()", "handle_events()", "EventHandler::prepare_events() is neither in the pseudocode nor"),
    ("check_stall()", "record(unit)", "Run::check_stall() is neither in the pseudocode nor in the list"),
    ("exchange_messages()", "transmit(unit, 0)", "EventHandler::exchange_messages() is neither"),
    ("handle_requests()", "handle_requests() should_continue()", "Run::should_continue() is in the pseudocode and in"),
    ("`step_order`", "`order_of_steps`", "order_of_steps is not in the code"),
    ("`kStepPolicies`", "`kPolicies`", "kPolicies is not in the code"),
    ("`stride::Time`", "`stride::Moment`", "stride::Moment is not in the code"),
    ("`EarlyReturn`", "`ReturnsEarly`", "ReturnsEarly is not in the code"),
    ("`fixedInternalStepSize`", "`fixedInnerStepSize`", "fixedInnerStepSize is not in the code"),
    ("`on_finish()`", "`on_end()`", "on_end is not in the code"),
    ("`on_finish()`", "`Stepper::on_finish()`", "Stepper has no function on_finish()"),
]


class PageTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.page = names_test.page_of(ROOT)
        cls.code = names_test.code_of(ROOT)

    def test_accepts_the_page(self):
        self.assertEqual(names_test.mistakes(self.page, self.code), [])

    def test_refuses_each_mistake(self):
        for text, other, report in MISTAKES:
            with self.subTest(f"{text} -> {other}"):
                self.assertGreater(self.page.count(text), 0)
                found = names_test.mistakes(self.page.replace(text, other), self.code)
                self.assertTrue(any(report in mistake for mistake in found), found)

    def test_refuses_functions_in_each_others_place(self):
        for one, other in [("make_passes", "make_pass"), ("evaluate_loop", "evaluate"), ("attempt", "record"),
                           ("initialize", "communication_step")]:
            with self.subTest(f"{one} <-> {other}"):
                places = {one: other, other: one}
                page = re.sub(rf"\b({one}|{other})\(", lambda found: places[found[1]] + "(", self.page)
                found = names_test.mistakes(page, self.code)
                self.assertTrue(any("does not call" in mistake for mistake in found), found)

    def test_refuses_a_block_that_is_missing(self):
        for block in names_test.BLOCK.findall(self.page):
            if "fmi2DoStep" in block:
                continue
            with self.subTest(block.split("\n")[0]):
                self.assertNotEqual(names_test.mistakes(self.page.replace(block, ""), self.code), [])

    def test_refuses_a_function_that_the_page_and_the_list_lack(self):
        code = copy.copy(self.code)
        code.functions = code.functions - {("Stepper", "step_plainly")} | {("Stepper", "step_simply")}
        found = names_test.mistakes(self.page, code)
        self.assertEqual(len(found), 2)
        self.assertIn("Stepper::step_plainly(), which", found[0])
        self.assertIn("Stepper::step_simply() is neither", found[1])


class DeclarationsTest(unittest.TestCase):
    def check(self, text, *functions):
        self.assertEqual(declarations.declared_functions([text]), set(functions))

    def test_finds_members_and_free_functions(self):
        self.check("namespace a::b {\nclass Outer : public Base<int> {\n public:\n  explicit Outer(int a);\n"
                   "  [[nodiscard]] std::vector<int> list() const { return make(1); }\n"
                   "  struct Inner { void deep(); };\n  std::function<void(int)> callback;\n};\n"
                   "void free_one(int a = 1);\n}\n",
                   ("Outer", "list"), ("Inner", "deep"), ("", "free_one"))

    def test_finds_definitions(self):
        self.check("inline Time Stepper::pass(int a) {\n  if (a) call(a);\n  return other();\n}\n"
                   "Stepper::Stepper(int a) : a_(a) {}\nclass Simulation::Run { void run(); };\n",
                   ("Stepper", "pass"), ("Run", "run"))

    def test_leaves_out_calls_comments_and_strings(self):
        self.check("// void a();\n/* void b(); */\nconst char* text = \"{ void c(); \";\n#define D void d()\n"
                   "int e() { return f() + g(\"}\"); }\n", ("", "e"))


if __name__ == "__main__":
    unittest.main()
