# What a master and `stride serve` send to each other once they have greeted each other (greeting.h). Each message is
# cut into frames (frame.h).
#
# How it may change: fields and members of unions are added with the next number, never renumbered, and what an older
# peer does not know it refuses by name of the request's number ("request 40 is not known here"). What it may not
# ignore raises kProtocol in greeting.h, and then both sides say which versions they have.
#
# Conventions. Times and durations are picoseconds. References are value references of FMI. Numbers are little-endian
# and one behind the other, as in the memory of the machines that stride runs on: `Data` of doubles, or of the type of
# their variables. Data of one type has the size that follows from the description of the unit, which both sides know;
# another size is an error.

@0xc3a8e1f5d7b64092;

using Cxx = import "/capnp/c++.capnp";
$Cxx.namespace("stride::remote::wire");

struct Values {
  # The elements of one block of values, or of several behind each other.
  numbers @0 :Data;        # of blocks of numbers, Booleans (1 byte, 0 or 1) and clocks (likewise)
  texts @1 :List(Data);    # of blocks of String and Binary
}

struct Block {
  # Variables of one type.
  type @0 :UInt8;          # core::ValueType
  size @1 :UInt64;         # elements of all of them
  references @2 :List(UInt32);
}

struct OptionalTime {
  isThere @0 :Bool;
  time @1 :Int64;
}

enum Capability {
  configurationMode @0;
  stateSaving @1;
  stateSerialization @2;
  resetting @3;
  idlePromises @4;
  directionalDerivatives @5;
  clockIntervals @6;
  inputsWithinStep @7;
  messageText @8;
  unitDiagnostics @9;
}

struct Request {
  # From the master. The server carries requests out in their order.
  isAwaited @0 :Bool;
  # Whether the master waits for an answer. A failure of a request that is not awaited is the answer to the next one
  # that is, and requests between them are not carried out.

  union {
    ping @1 :Void;
    describe @2 :Text;                 # the FMU of this path or name; empty: the only one that is offered
    sendFile @3 :FilePiece;            # an FMU, piece by piece, in place of one that is there
    instantiate @4 :Instantiate;
    enterConfigurationMode @5 :Void;
    exitConfigurationMode @6 :Void;
    enterInitialization :group { start @7 :Int64; stop @8 :OptionalTime; }
    exitInitialization @9 :Void;
    get @10 :Block;
    set :group { block @11 :Block; values @12 :Values; }
    makePlan @13 :Plan;
    step @14 :Step;
    saveState @15 :Void;
    restoreState @16 :Void;
    selectState @17 :UInt32;
    serializeState @18 :Void;
    deserializeState @19 :Data;
    reset @20 :Void;
    enterEventMode @21 :Void;
    updateDiscreteStates @22 :Void;
    enterStepMode @23 :Void;
    getClockInterval @24 :UInt32;
    getClockShift @25 :UInt32;
    getDirectionalDerivative :group {
      unknowns @26 :List(UInt32);
      knowns @27 :List(UInt32);
      seed @28 :Data;
    }
    setInputUpdate @29 :Bool;
    enableIdleSkipping @30 :Int64;
    setIdleTolerances :group { outputs @31 :List(UInt32); tolerances @32 :Data; }
    getIdleUntil @33 :Void;
    getDerivatives @34 :List(UInt32);
    describeMessage :group { variable @35 :UInt32; value @36 :Data; }
    setRepeating @37 :Bool;
    getStatistics @38 :Void;
    terminate @39 :Void;
    free @40 :Void;                    # the files of the unit are there until the connection ends
    inputsUpdated @41 :Void;           # in answer to inputsNeeded
    inputsNotUpdated @42 :Void;        # likewise: that has failed
    getFiles @43 :Void;                # that the unit has written, in answer: `file` for each piece, then done
  }
}

struct FilePiece {
  name @0 :Text;           # relative to its folder, with '/'
  bytes @1 :Data;          # behind those of the piece before
  isFirst @2 :Bool;
}

struct Instantiate {
  fmu @0 :Text;            # as in `describe`; ignored if a file was sent
  digest @1 :Text;         # of the description that the master has (SHA-256), so that both mean the same unit
  name @2 :Text;           # of the component
  file @3 :Text;           # the component's place in the scenario, for errors
  line @4 :Int32;
  earlyReturnAllowed @5 :Bool;
  intermediateUpdate @6 :Bool;
  mayGoBack @7 :Bool;
  debugLogging @8 :Bool;
  step @9 :OptionalTime;   # of regular steps, rounded
  sizes @10 :List(Size);   # of arrays, given by structural parameters
  canSaveState @11 :Bool;  # whether its own functions for its state may be used
  canSerializeState @12 :Bool;
  callLimit @13 :UInt64;   # [ms]; 0 = none
  memoryLimit @14 :UInt64; # [byte]; 0 = none
  isSandboxed @15 :Bool;
  takesSnapshots @16 :Bool;
  stepSeconds @17 :Float64;  # the step, not rounded: core::Interval::from_seconds(); 0 from older peers

  struct Size { parameter @0 :UInt32; elements @1 :UInt64; }
}

struct Plan {
  # What steps exchange, sent once.
  number @0 :UInt32;
  inputs @1 :List(Block);
  outputs @2 :List(Block);
}

struct Step {
  plan @0 :UInt32;
  from @1 :Int64;
  to @2 :Int64;
  beginSeconds @3 :Float64;
  endSeconds @4 :Float64;
  sizeSeconds @5 :Float64;
  mayGoBackBefore @6 :Bool;
  savesState @7 :Bool;     # before the step, with its inputs
  inputs @8 :Values;
}

struct Reply {
  # From the server: the answer to a request, or what is said meanwhile.
  union {
    done @0 :Result;
    failed @1 :Error;
    callbackFailed @2 :Void;           # what the master did for inputsNeeded has failed
    inputsNeeded @3 :Float64;          # in a step, so many seconds after its begin; then inputs(Not)Updated is expected
    log @4 :LogMessage;                # of the unit
    beat @5 :Void;                     # this machine is still there
    file @6 :FilePiece;
  }
}

struct Result {
  calls @0 :UInt64;        # of functions of the unit, so far
  nanoseconds @1 :UInt64;  # that the request has taken here
  union {
    none @2 :Void;
    description @3 :Description;
    instance @4 :Instance;
    values @5 :Values;
    step @6 :StepResult;
    events @7 :EventResult;
    bytes @8 :Data;
    clock :group {         # core::ClockInterval: a fraction of picoseconds
      state @9 :UInt8;
      numeratorHigh @10 :UInt64;
      numeratorLow @11 :UInt64;
      denominator @12 :UInt64;
    }
    numbers @13 :Data;     # of doubles
    time @14 :Int64;
    text @15 :Text;
    statistics @16 :Statistics;
  }
}

struct Description {
  path @0 :Text;           # of the FMU, there
  files @1 :List(FilePiece);  # modelDescription.xml and what else describes the unit: nothing of its code
}

struct Instance {
  capabilities @0 :List(Capability);
  protections @1 :List(Text);
  missingProtections @2 :List(Text);
}

struct StepResult {
  isRejected @0 :Bool;
  isEarlyReturn @1 :Bool;
  eventHandlingNeeded @2 :Bool;
  terminateSimulation @3 :Bool;
  reached @4 :Int64;
  outputs @5 :Values;      # unless it was rejected
  reason @6 :Text;         # why it was
}

struct EventResult {
  discreteStatesNeedUpdate @0 :Bool;
  terminateSimulation @1 :Bool;
  nextEventTime @2 :OptionalTime;
}

struct Statistics {
  snapshots @0 :UInt64;
  restores @1 :UInt64;
  mostSnapshots @2 :UInt64;
  mostSnapshotMemory @3 :UInt64;
  mostMemory @4 :UInt64;
}

struct Error {
  isOfInput @0 :Bool;      # core::Error::Kind
  isConsequent @1 :Bool;   # core::ConsequentError
  isOfEnvironment @2 :Bool;  # core::EnvironmentError
  file @3 :Text;
  line @4 :Int32;
  unit @5 :Text;
  variable @6 :Text;
  time @7 :OptionalTime;
  message @8 :Text;
  hint @9 :Text;
}

struct LogMessage {
  status @0 :UInt8;        # importer::Status
  category @1 :Text;
  text @2 :Text;
}
