#!/usr/bin/env zsh
# What a real zsh offers with the completion that the program writes: it is run on a terminal of its own.
#   zsh_test.zsh STRIDE SCENARIO-FOLDER
emulate -R zsh
zmodload zsh/zpty || exit 1

stride=$1
scenarios=$2
work=$(mktemp -d)
trap 'rm -rf $work' EXIT
mkdir -p $work/functions
$stride reference zsh > $work/functions/_stride
zsh -n $work/functions/_stride || exit 1
cp -r $scenarios/nfc_approach $work/here
touch $work/here/unit.fmu
failures=0

zpty -b shell zsh -f -i
zpty -w shell "PS1=; stty -echo; cd $work/here; path=(${stride:h} \$path); fpath=($work/functions \$fpath)"
zpty -w shell "autoload -Uz compinit; compinit -u -D; compdef _stride stride"
zpty -w shell 'tell() { print -r -- "<$BUFFER>"; BUFFER= }; zle -N tell'
zpty -w shell 'bindkey "^X" tell; bindkey "^I" complete-word'
zpty -w shell 'print rea""dy'
zpty -r -m shell answer '*ready*'

# offers 'the line as it becomes' LINE, where TAB is typed behind it
offers() {
  local answer
  zpty -w -n shell "$2"$'\t\x18'
  zpty -r -m shell answer '*<*>*'
  answer=${${answer##*<}%%>*}
  [[ $answer == $1 ]] && return
  print -r -- "'$2' becomes '$answer', expected '$1'"
  failures=1
}

offers 'stride inspect ' 'stride ins'
offers 'stride run --policy=' 'stride run --pol'
offers 'stride run --policy=fixed ' 'stride run --policy=f'
offers 'stride run --policy fixed ' 'stride run --policy f'
offers 'stride run -o golden/' 'stride run -o go'
offers 'stride run nfc_approach.ssd ' 'stride run nfc_approach.'
offers 'stride run nfc_far ' 'stride run nfc_f'
offers 'stride check nfc_brownout ' 'stride check nfc_b'
offers 'stride run nfc_far --set reader.' 'stride run nfc_far --set rea'
offers 'stride inspect unit.fmu ' 'stride inspect uni'
offers 'stride run nfc_approach.ssd --swap=sensor=' 'stride run nfc_approach.ssd --swap=sen'
offers 'stride run nfc_approach.ssd --swap sensor=unit.fmu ' 'stride run nfc_approach.ssd --swap sensor=un'
offers 'stride run nfc_approach.ssd --set reader.' 'stride run nfc_approach.ssd --set rea'
offers 'stride run nfc_approach.ssd --isolate=sensor ' 'stride run nfc_approach.ssd --isolate=sen'
offers 'stride trace info ' 'stride trace inf'
offers 'stride trace info --min-gap=' 'stride trace info --m'
offers 'stride trace expand --cut-off ' 'stride trace expand --cu'
offers 'stride verify --check determinism ' 'stride verify --check det'
exit $failures
