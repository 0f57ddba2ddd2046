#!/usr/bin/env fish
# What a real fish offers with the completion that the program writes.
#   fish_test.fish STRIDE SCENARIO-FOLDER
set -g stride $argv[1]
set -g work (mktemp -d)
set -gx HOME $work
$stride reference fish >$work/stride.fish
fish --no-execute $work/stride.fish; or exit 1
source $work/stride.fish
set -gx PATH (dirname $stride) $PATH
cp -r $argv[2]/nfc_approach $work/here
cd $work/here
touch unit.fmu
set -g failures 0

# offers 'the words offered' LINE: for the last word of the line; descriptions are left out
function offers
    set -l offered (complete -C $argv[2] 2>$work/errors | string replace -r '\t.*' '')
    if test -s $work/errors
        cat $work/errors
        set -g failures 1
    end
    if test "$offered" != "$argv[1]"
        echo "'$argv[2]' offers '$offered', expected '$argv[1]'"
        set -g failures 1
    end
end

offers 'run' 'stride ru'
offers '--verbose --version' 'stride --ver'
offers '--policy' 'stride run --pol'
offers 'error-controlled event-driven fixed' 'stride run --policy '
offers 'golden/' 'stride run --out go'
offers 'nfc_approach.ssd' 'stride run nfc_approach.s'
offers 'nfc_far' 'stride run nfc_fa'
offers 'reader.' 'stride run nfc_far --set rea'
offers 'unit.fmu' 'stride inspect un'
offers 'sensor=' 'stride run nfc_approach.ssd --swap sen'
offers 'sensor=unit.fmu' 'stride run nfc_approach.ssd --swap sensor=un'
offers 'reader.' 'stride run nfc_approach.ssd --set rea'
offers '--isolate=channel' 'stride run nfc_approach.ssd --isolate=ch'
offers 'compress expand info' 'stride trace '
offers '--min-gap' 'stride trace info --m'
offers '' 'stride trace expand --m'
offers 'dependencies description determinism' 'stride verify --check de'
rm -rf $work
exit $failures
