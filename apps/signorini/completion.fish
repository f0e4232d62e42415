# Completion of fish for signorini. What may follow is asked of the program itself, `signorini words`.
function __signorini_complete
    set -l before (commandline -opc)
    set -l word (commandline -ct)
    set -l program $before[1]
    set -l command $before[2]
    # What is below another command has both words.
    if test "$command" = plugin; and set -q before[3]
        set command "plugin $before[3]"
    end
    if not set -q before[2]
        $program words 2>/dev/null
    else if test "$before[-1]" = --kind
        $program words "$command --kind" 2>/dev/null
    else if test "$before[-1]" = --set; and not string match -q 'plugin*' -- $command
        $program words set 2>/dev/null
    else if string match -q -- '-*' $word; or contains -- $command list help plugin
        $program words $command 2>/dev/null
    else
        switch $command
            case solve check
                __signorini_files $word .toml
            case 'plugin check'
                __signorini_files $word .so
            case '*'
                __fish_complete_path $word
        end
    end
end

# Folders, and the files that end as said.
function __signorini_files -a word ending
    __fish_complete_directories $word
    __fish_complete_path $word | string match -- "*$ending*"
end

complete -c signorini -f -a '(__signorini_complete)'
