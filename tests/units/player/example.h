#ifndef STRIDE_TESTS_UNITS_PLAYER_EXAMPLE_H
#define STRIDE_TESTS_UNITS_PLAYER_EXAMPLE_H

#include <stdexcept>
#include <string>

namespace stride::tests {

/// Stimuli with a bit of everything.
inline std::string example() {
  return "stride stimuli,1\n"
         "unit,lamp\n"
         "component,left\n"
         "system,room\n"
         "input,level,Float64,continuous,V,,,0\n"
         "input,mode,Enumeration,discrete,,,,1\n"
         "item,mode,off,1\n"
         "item,mode,on,2\n"
         "input,message.clock,Clock,discrete,,,\n"
         "input,message.text,String,discrete,,message.clock,,\"\"\n"
         "input,flags,Boolean,discrete,,,2 1,false,true\n"
         "set,gain,2\n"
         "set,level,9\n"
         "skip,1\n"
         "time,event,variable,value\n"
         "0,,level,0.5\n"
         "0,0,mode,2\n"
         "0,0,flags,true,true\n"
         "0,step,,0.25\n"
         "0.25,,level,0.75\n"
         "0.25,step,,0.5\n"
         "0.25,step,,0.5\n"
         "0.499999999999,0,mode,1\n"
         "0.499999999999,1,message.clock,\n"
         "0.499999999999,1,message.text,\"a, \"\"b\"\"\nc\"\n"
         "0.499999999999,step,,1\n"
         "1,end,,\"completed\"\n";
}

inline std::string replaced(std::string text, const std::string& before, const std::string& after) {
  const std::size_t at = text.find(before);
  if (at == std::string::npos) throw std::logic_error("there is no " + before);
  return text.replace(at, before.size(), after);
}

}  // namespace stride::tests

#endif
