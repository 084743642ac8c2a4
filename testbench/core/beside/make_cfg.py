import sys,re,tomllib
rtl,design,out=sys.argv[1:4]
pkg=open(f"{rtl}/generated/{design}/feltgate_pkg.sv").read()
mp=open(f"{rtl}/generated/feltgate_map_pkg.sv").read()
reg=tomllib.load(open(f"{rtl}/registers.toml","rb"))
K={m[1]:int(m[2]) for m in re.finditer(r"localparam int (\w+) = (-?\d+);",pkg)}
W=lambda n:K[n+"_W"]
# words
MAG={"overspeed","voltage_step","torque_limit","ramp_step","region_torque","hold_torque","hold_limit","current_limit","dead_voltage","voltage_window","self_test_torque","polarity_speed","polarity_current","membrane_torque"}
INT={"polarity_ticks":16,"watchdog_ticks":24,"hold_time":14,"self_test_quiet":8,"self_test_pulse":8,"self_test_arms":2}
words=[];above={}
scenes={s["name"]:s["number"] for s in reg["scene"]}
for q in reg["parameter"]:
    n=q["name"]
    if q.get("option") and K["PHASES"]!=3: continue
    k=q["kind"]; signed=False
    if k=="coefficient": bits=17
    elif k=="signed": bits,signed=18,True
    elif k=="signal":
        f=q["format"].upper()
        bits=W(f); signed=f not in("I2T","CHARGE")
        if n in MAG: bits-=1; signed=False
    elif k=="counts": bits,signed=26,True
    elif k=="angle": bits=32
    else: bits=q.get("bits",INT.get(n,32))
    if n=="duty_limit": bits=12
    sc=q.get("scene")
    addr=q["slot"] if not sc else scenes[sc]*32+q["slot"]
    mask=((1<<32)-1) & ~((1<<(bits-1 if signed else bits))-1)
    above[addr]=(int(signed),mask,n)
    if not sc: words.append((n,bits,signed,addr))
for place,bits,signed in((1,26,True),(2,32,False),(3,17,False),(6,18,False),(10,max(17,W("TORQUE")),True)):
    words.append((f"scene_{place}",bits,signed,15*32+place))
fields=words
resets={int(m[1]):int(m[2]) for m in re.finditer(r"9'd(\d+): parameter_reset = 32'd(\d+);",pkg)}
total=sum(w[1] for w in words)
L=[]
low=total
lows=[]
for n,b,s,a in words:
    low-=b; lows.append(low)
L.append("\n  // Words of params_t: place, width and address of each.\n  localparam int WORDS = %d;"%len(words))
def vec(v): return "{"+", ".join(f"16'd{x}" for x in reversed(v))+"}"
N=len(words)
L.append(f"  localparam logic [{16*N-1}:0] WORD_LOW = {vec(lows)};")
L.append(f"  localparam logic [{16*N-1}:0] WORD_BITS = {vec([w[1] for w in words])};")
L.append(f"  localparam logic [{16*N-1}:0] WORD_ADDRESS = {vec([w[3] for w in words])};")
L.append(f"  localparam int PARAMS_W = {total};")
L.append(f"  localparam logic [{total-1}:0] PARAMS_RESET = {{"+", ".join(f"{b}'d{resets.get(a,0)&((1<<b)-1)}" for n,b,s,a in words)+"};")
L.append("  typedef struct packed {")
for n,b,s,a in words: L.append(f"    logic {'signed ' if s else ''}[{b-1}:0] {n};")
L.append("  } params_t;")
TW=max(6,(K["CLOCKS_PER_TICK"]-1).bit_length())
L.append(f"  localparam int TICK_W = {TW};")
def struct(name,fs):
    L.append("  typedef struct packed {")
    for t,n in fs: L.append(f"    logic {t+' ' if t else ''}{n};")
    L.append(f"  }} {name};")
sg=lambda w:f"signed [{w-1}:0]"
u=lambda w:f"[{w-1}:0]"
struct("tick_t",[(u(TW),"clock"),("","sample"),("","velocity"),("","tau_hat"),("","scene"),("","tau_ref"),("","duty"),("","last"),(u(32),"count")])
struct("encoder_t",[("","sample"),(u(32),"tick_count"),(u(4),"filter"),("","polarity"),("","set_zero"),("","clear"),("","gates_enable")])
struct("position_t",[(sg(32),"position"),(sg(32),"count"),(sg(16),"travel"),("","moved"),("","chatters"),("","illegal"),("","error"),(u(16),"error_count"),(u(16),"rejected_count"),(sg(32),"index_position"),("","polarity_holds"),("","trip_channel"),("","trip_index"),("","trip_flip"),(u(6),"why")])
L.append(f"  localparam int FEED_W = {W('VOLTAGE')+3};")
struct("drive_t",[("","gates_enable"),("","gates_clear"),("","clear"),("","pwm_mode"),("","polarity"),("","direct"),("","sample"),("","valid"),(sg(W("CURRENT")),"current"),(sg(W("VOLTAGE")+3),"feed"),(sg(W("DUTY")),"duty")])
struct("bridge_t",[("","measured"),("","period_start"),(sg(W("DUTY")),"duty_active"),(sg(W("CURRENT")),"current"),(u(7),"why")])
struct("panel_t",[("","arm"),("","stop"),("","set_zero"),(u(4),"scene")])
struct("law_t",[(sg(W("TORQUE")),"torque"),("","late"),("","restart")])
struct("peers_t",[("","fault"),("","silent"),("","blocked"),("","testing"),("","waits")])
struct("control_t",[(u(4),"filter"),("","pwm_mode"),("","encoder_polarity"),("","motor_polarity"),(u(2),"mode"),(u(4),"scene"),("","arm"),("","host")])
struct("commands_t",[("","host"),("","host_arm"),("","panel_arm"),("","disarm"),("","stop"),("","host_stop"),("","clear_faults"),("","kick"),(u(2),"mode")])
struct("safety_t",[("","armed"),("","locks"),("","gates_enable"),("","gates_clear"),("","clear"),("","arm_request"),("","ready"),("","unkicked"),("","derated"),("","testing"),(sg(W("SCENE_TORQUE")),"test_torque"),(u(2),"test_result"),(u(16),"faults"),(u(5),"first_fault"),(sg(W("CURRENT_ESTIMATE")),"current_estimate")])
struct("snapshot_t",[(u(32),"tick"),(sg(32),"position"),(u(32),"status"),(u(32),"faults"),(u(32),"encoder"),(sg(32),"index"),(u(4),"scene"),(u(12),"limits"),(sg(W("VELOCITY")),"velocity"),(sg(W("TORQUE")),"tau_hat"),(sg(W("TORQUE")),"tau_ref"),(sg(W("CURRENT")),"current"),(sg(W("VOLTAGE")),"voltage"),(sg(W("DUTY")),"duty")])
struct("word_t",[("","valid"),(u(6),"place"),(u(32),"data")])
pkg=pkg.replace("package feltgate_pkg","package cfg")
i=pkg.index("  // Whether a parameter has a sign"); j=pkg.index("endpackage")
fn="\n  function automatic logic [32:0] parameter_above(input logic [8:0] address);\n    case (address)\n"+"".join(f"      9'd{a}: parameter_above = {{1'd{s}, 32'h{m:08x}}};  // {n}\n" for a,(s,m,n) in sorted(above.items()))+"      default: parameter_above = 33'd0;\n    endcase\n  endfunction\n"
pkg=pkg[:i]+fn.lstrip("\n")+"\n".join(L)+"\n"+pkg[j:]
pkg=re.sub(r"localparam int CONTROL_RESET = (\d+);",r"localparam logic [14:0] CONTROL_RESET = 15'd\1;",pkg)
pkg=re.sub(r"localparam int SCENE_MASK = (\d+);",r"localparam logic [15:0] SCENE_MASK = 16'd\1;",pkg)
open(out+"/cfg.sv","w").write(pkg)
mp=mp.replace("package feltgate_map_pkg","package map")
mp=re.sub(r"  localparam int (PARAM_AT|PRODUCT_AT|EVENT_AT)_\w+ = \d+;.*\n","",mp)
mp=re.sub(r"localparam int READ_AT_(\w+) = (\d+);",r"localparam logic [5:0] S_\1 = 6'd\2;",mp)
open(out+"/map.sv","w").write(mp)
