"""names_test.py ROOT: docs/stepping.md uses the names of the code, and shows its algorithm whole.

- Each function of the pseudocode is declared or defined in master/engine; a qualified one (Class::function) is a
  member of that class.
- A function calls those that the pseudocode shows in it, itself or by functions that the pseudocode leaves out.
- Each name in backticks that is written like one of the code (step_order, kStepPolicies, StepPolicy, stride::Time) is
  in a header of master/ or interfaces/, or is one of XML that master/loader/fmu or master/system reads.
- Each member function of the classes of SHOWN is in the pseudocode or in the list of those that it leaves out.
"""

import pathlib
import re
import sys

import declarations

BLOCK = re.compile(r"^```text\n(.*?)^```", flags=re.MULTILINE | re.DOTALL)
ANY_BLOCK = re.compile(r"^```.*?^```", flags=re.MULTILINE | re.DOTALL)
DEFINITION = re.compile(r"^(?:(\w+)::)?(\w+)\(.*\):(?:\s*#.*)?$")
CALL = re.compile(r"(?:(\w+)::)?\b([a-z]\w*)\(")
IN_BACKTICKS = re.compile(r"`((?:\w+::)*[A-Za-z]\w*)(?:\(\))?`")
LIKE_CODE = re.compile(r"::|_|^k?[A-Z]|[a-z][A-Z]")
# g(x) is a function of mathematics; FMI's own names are not those of the code
NOT_OURS = re.compile(r"g$|fmi[23]")
PLACEHOLDER = "Class::function"

# The functions that the pseudocode leaves out: access to members, measurement of wall time, what an optimisation needs,
# what only builds or reports an error.
SHOWN = {
    "Run": "abandon note_requested_end add_observer statistics suspended_time was_suspended verdicts count "
           "sets_inputs_in_steps inputs_in_steps make_own_steps are_steps_on_grid "
           "coasting add_wall_time finish_suspensions finish_observers start make_part check_between_parts conclude "
           "value read_value read_output "
           "set_control run_rest end_behind persist add_interventions persist_all persist_statistics "
           "notify_observers start_observers make_input_extrapolator make_idle_scheduler "
           "connect_input_updates should_continue make_stretch conclude_step",
    "Stepper": "result has_requests steps was_parallel make_timed_passes step_together step_share succeeds "
               "may_be_regular advance_regularly make_further_passes "
               "form_stages form_rows row_members coasting_row step_rows step_whole_rows note_stop_in note_plain_ones note_outcome note_step "
               "note_whole_rows count_whole_rows "
               "batches interval step_one_by_one step_plainly make_step save_and_step reached_by attempt_timed begin_timed "
               "finish persist prepare conclude report record_time index name rethrow_failure reason hint_for_final fail_final plan pool",
    "IdleScheduler": "add_candidate all_suspended_until catch_up_and_report check_promise covers drop_tangents find_sources "
                     "is_disturbed is_suspended is_trivial leaves_deadband may_suspend persist persist_tangents report_suspension "
                     "report_unfinished suspended_time was_suspended",
    "OrderedEvaluation": "check_nan find_direct_inputs is_trivial plan report sweep takes_part",
    "AlgebraicLoop": "collect fail has_converged have_held_values_converged hint inputs put sweep values_text",
    "InputExtrapolator": "persist sample set_targets signal_of undo_step within_step "
                         "set_own_steps keeps_own_step is_behind",
    "OwnSteps": "is_trivial keeps count are_multiples_of reached next_event_from must_wait steps set_event "
                "begin_step finish_step persist next_of_grid choose_due interval check_size reason "
                "fail_rejected",
    "StepPolicy": "persist regular_grid",
    "EventHandler": "had_event has_announced count description activate activate_announced update_announced "
                    "notify_observers receive report content_of described_by check_sent fail_nan fail_ticking fail_sample_loop "
                    "takes_part find_discontinuities quiet_until pass_quietly persist must_wait next_receipt set_in_event make_assignments disturb release report_disturbed",
}


DEFINED = {"Simulation", "Stepper", "EventHandler", "IdleScheduler", "OrderedEvaluation", "AlgebraicLoop",
           "InputExtrapolator", "OwnSteps"}


def sources(root, folder, endings=(".h", ".cpp")):
    return [path.read_text(encoding="utf-8") for path in sorted((root / folder).rglob("*"))
            if path.suffix in endings]


def calls(page):
    return {call for block in BLOCK.findall(page) for call in CALL.findall(block)}


def unknown_functions(page, functions):
    names = {function for _, function in functions}
    for owner, function in calls(page):
        if NOT_OURS.match(function):
            continue
        if function not in names:
            yield f"{function}() is not a function of master/engine"
        elif owner and (owner, function) not in functions:
            yield f"{owner} has no function {function}()"


def definitions(page):
    """(class, function, the functions called in it) of the pseudocode."""
    found = []
    for block in BLOCK.findall(page):
        for line in block.split("\n"):
            definition = DEFINITION.match(line)
            if definition:
                found.append((definition[1] or "", definition[2], []))
            elif found and line.startswith(" "):
                found[-1][2].extend(name for _, name in CALL.findall(line.split("#")[0]) if not NOT_OURS.match(name))
    return found


def reached(owner, function, shown, called):
    """What the function calls, itself or by others that are not in `shown`, which maps functions to their classes. A
    function of the same class is followed, too, where the page shows that of another class."""
    of_name = {}
    for declared in called:
        of_name.setdefault(declared[1], []).append(declared)
    left = [declared for declared in of_name.get(function, []) if declared[0] == owner or not owner]
    if owner == "Simulation":
        left = [("Run", function)]  # behind the public class
    done, names = set(), set()
    while left:
        caller = left.pop()
        if caller in done:
            continue
        done.add(caller)
        for name in called[caller]:
            names.add(name)
            classes = shown.get(name, set())
            left += [declared for declared in of_name.get(name, [])
                     if not classes or (declared[0] == caller[0] and not {"", declared[0]} & classes)]
    return names


def wrong_calls(page, called):
    pseudocode = definitions(page)
    shown = {}
    for owner, function, _ in pseudocode:
        shown.setdefault(function, set()).add(owner)
    for owner, function, callees in pseudocode:
        names = reached(owner, function, shown, called)
        for callee in callees:
            if callee not in names:
                yield f"{function}() does not call {callee}()"


def unknown_names(page, code):
    owners = {owner for owner, _ in code.members}
    for name in IN_BACKTICKS.findall(ANY_BLOCK.sub("", page)):
        owner, _, last = name.rpartition("::")
        if name == PLACEHOLDER or not LIKE_CODE.search(name):
            continue
        if not {last, f"{last}TYPE"} & code.words:  # FMI's headers have the types of its functions
            yield f"{name} is not in the code"
        elif owner and owner in owners and (owner, last) not in code.members:
            yield f"{owner} has no function {last}()"


def missing_functions(page, functions):
    shown = {function for _, function in calls(page)}
    defined = {owner for owner, _, _ in definitions(page)}
    for owner in DEFINED - defined:
        yield f"{owner} has no pseudocode"
    for owner, text in SHOWN.items():
        left_out = set(text.split())
        members = {function for of, function in functions if of == owner}
        for function in members - shown - left_out:
            yield f"{owner}::{function}() is neither in the pseudocode nor in the list of what that leaves out"
        for function in left_out - members:
            yield f"{owner}::{function}(), which the pseudocode is to leave out, is not in the code"
        for function in left_out & shown:
            yield f"{owner}::{function}() is in the pseudocode and in the list of what that leaves out"


def mistakes(page, code):
    return sorted({*unknown_functions(page, code.functions), *unknown_names(page, code),
                   *wrong_calls(page, code.called), *missing_functions(page, code.functions)})


class Code:
    """algorithm: texts of master/engine; headers: of the C++ headers; readers: of sources that read XML, whose names
    they have in quotes."""

    def __init__(self, algorithm, headers, readers):
        self.functions = declarations.declared_functions(algorithm)
        self.called = declarations.called_functions(algorithm)
        self.members = declarations.declared_functions(headers)
        self.words = {word for text in headers for word in re.findall(r"\w+", declarations.without_comments(text))}
        self.words |= {word for text in readers for word in re.findall(r'"(\w+)"', text)}


def page_of(root):
    return (root / "docs" / "stepping.md").read_text(encoding="utf-8")


def code_of(root):
    return Code(sources(root, "master/engine"),
                sources(root, "master", (".h",)) + sources(root, "interfaces", (".h",)),
                sources(root, "master/loader/fmu") + sources(root, "master/system"))


def main(root):
    root = pathlib.Path(root)
    found = mistakes(page_of(root), code_of(root))
    for mistake in found:
        print(f"docs/stepping.md: {mistake}")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
