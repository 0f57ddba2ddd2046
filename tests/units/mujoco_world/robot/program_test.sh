#!/usr/bin/env bash
# program_test.sh STRIDE-ROBOT: what the program says, and its exit code, where something is given wrongly.
set -uo pipefail
robot=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
mistakes=0

# says CODE TEXT ARGUMENT...: the program ends with that code and says that text
says() {
  local code=$1 text=$2 output
  shift 2
  output=$("$robot" "$@" 2>&1)
  local got=$?
  if [ $got -ne "$code" ] || [[ "$output" != *"$text"* ]]; then
    echo "stride-robot $*: exit code $got, expected $code and '$text'; it said:"
    echo "$output"
    mistakes=$((mistakes + 1))
  fi
}

mkdir world
cat > world/scene.xml <<'XML'
<mujoco>
  <worldbody>
    <site name="tag_coil"/>
    <body name="lift" pos="0 0 1">
      <joint name="up" type="slide" axis="0 0 1" range="-1 1" limited="true"/>
      <geom size="0.01" mass="1" pos="0 0 0.1"/>
      <site name="reader_coil" euler="180 0 0"/>
    </body>
  </worldbody>
  <actuator><position name="up" joint="up" kp="1000" forcelimited="true" forcerange="-5 5"/></actuator>
</mujoco>
XML

says 0 "Usage" --help
says 2 "subcommand is required"
says 2 "MODEL is required" show
says 2 "--output is required" convert world/scene.xml
says 2 "stride-robot: error: --mount lift: expected BODY=FILE" convert world/scene.xml -o out.xml --mount lift
says 2 "stride-robot: error: absent.urdf: cannot be read" show absent.urdf
says 2 "stride-robot: error: no folder 'nowhere'" reach nowhere --distance 0.1
says 2 "stride-robot: error: Could not convert: --distance = near" reach world --distance near
says 0 "joint up, -1 … 1 m" show world
says 0 "actuator up, m" show world
says 0 '<pose name="at_12_5_cm" up="-0.8652"/>' reach world --distance 0.125
says 0 "the drive of up is too weak to hold that" reach world --distance 0.125
[ -e out.xml ] && { echo "a mistake left a file"; mistakes=$((mistakes + 1)); }
exit $((mistakes > 0))
