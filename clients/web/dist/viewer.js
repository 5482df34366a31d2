// dhpmap viewer: BSD-3-Clause. Bundles three.js and three-mesh-bvh: MIT.
var fp=0,xu=1,pp=2;var vo=1,mp=2,ir=3,Nn=0,Zt=1,wt=2,ds=0,sr=1,_u=2,vu=3,bu=4,gp=5;var fs=100,yp=101,xp=102,_p=103,vp=104,bp=200,Mp=201,Sp=202,wp=203,Mu=204,Su=205,Tp=206,Ap=207,Ep=208,Cp=209,Rp=210,Pp=211,Ip=212,Lp=213,Np=214,Ua=0,Fa=1,Ba=2,Gs=3,ka=4,za=5,Va=6,Ga=7,wu=0,Dp=1,Op=2,hi=0,Tu=1,Au=2,Eu=3,Cu=4,Ru=5,Pu=6,Iu=7;var Lu=300,ps=301,rr=302,fl=303,pl=304,Ha=1e3,ai=1001,Wa=1002,Dt=1003,Up=1004;var bo=1005;var pn=1006,ml=1007;var Ei=1008;var vn=1009,Nu=1010,Du=1011,or=1012,gl=1013,Wn=1014,Cn=1015,Qn=1016,yl=1017,xl=1018,ms=1020,Ou=35902,Uu=35899,Fu=1021,Bu=1022,Rn=1023,Ti=1026,Ci=1027,ku=1028,Mo=1029,Xi=1030,_l=1031;var vl=1033,So=33776,wo=33777,To=33778,Ao=33779,bl=35840,Ml=35841,Sl=35842,wl=35843,Tl=36196,Al=37492,El=37496,Cl=37488,Rl=37489,Eo=37490,Pl=37491,Il=37808,Ll=37809,Nl=37810,Dl=37811,Ol=37812,Ul=37813,Fl=37814,Bl=37815,kl=37816,zl=37817,Vl=37818,Gl=37819,Hl=37820,Wl=37821,Xl=36492,ql=36494,$l=36495,Yl=36283,jl=36284,Co=36285,Zl=36286;var Yr=2300,Xa=2301,Da=2302,ou=2303,au=2400,lu=2401,cu=2402;var Fp=3200;var zu=0,Bp=1,Ri="",dn="srgb",jr="srgb-linear",Zr="linear",ht="srgb";var Oa=7680;var kp=519,zp=512,Vp=513,Gp=514,Vu=515,Hp=516,Wp=517,Gu=518,Hu=519,Wu=35044;var Xu="300 es",Gn=2e3,Jr=2001;function by(i){for(let e=i.length-1;e>=0;--e)if(i[e]>=65535)return!0;return!1}function My(i){return ArrayBuffer.isView(i)&&!(i instanceof DataView)}function Kr(i){return document.createElementNS("http://www.w3.org/1999/xhtml",i)}function Xp(){let i=Kr("canvas");return i.style.display="block",i}var Cf={},Hs=null;function Qr(...i){let e="THREE."+i.shift();Hs?Hs("log",e,...i):console.log(e,...i)}function qp(i){let e=i[0];if(typeof e=="string"&&e.startsWith("TSL:")){let t=i[1];t&&t.isStackTrace?i[0]+=" "+t.getLocation():i[1]='Stack trace not available. Enable "THREE.Node.captureStackTrace" to capture stack traces.'}return i}function Re(...i){i=qp(i);let e="THREE."+i.shift();if(Hs)Hs("warn",e,...i);else{let t=i[0];t&&t.isStackTrace?console.warn(t.getError(e)):console.warn(e,...i)}}function Ne(...i){i=qp(i);let e="THREE."+i.shift();if(Hs)Hs("error",e,...i);else{let t=i[0];t&&t.isStackTrace?console.error(t.getError(e)):console.error(e,...i)}}function Xr(...i){let e=i.join(" ");e in Cf||(Cf[e]=!0,Re(...i))}function $p(i,e,t){return new Promise(function(n,s){function r(){switch(i.clientWaitSync(e,i.SYNC_FLUSH_COMMANDS_BIT,0)){case i.WAIT_FAILED:s();break;case i.TIMEOUT_EXPIRED:setTimeout(r,t);break;default:n()}}setTimeout(r,t)})}var Yp={[Ua]:Ua,[Ba]:Va,[ka]:ka,[Gs]:za,[Fa]:Fa,[Va]:Ba,[Ga]:Ga,[za]:Gs},li=class{addEventListener(e,t){this._listeners===void 0&&(this._listeners={});let n=this._listeners;n[e]===void 0&&(n[e]=[]),n[e].indexOf(t)===-1&&n[e].push(t)}hasEventListener(e,t){let n=this._listeners;return n===void 0?!1:n[e]!==void 0&&n[e].indexOf(t)!==-1}removeEventListener(e,t){let n=this._listeners;if(n===void 0)return;let s=n[e];if(s!==void 0){let r=s.indexOf(t);r!==-1&&s.splice(r,1)}}dispatchEvent(e){let t=this._listeners;if(t===void 0)return;let n=t[e.type];if(n!==void 0){e.target=this;let s=n.slice(0);for(let r=0,o=s.length;r<o;r++)s[r].call(this,e);e.target=null}}},tn=["00","01","02","03","04","05","06","07","08","09","0a","0b","0c","0d","0e","0f","10","11","12","13","14","15","16","17","18","19","1a","1b","1c","1d","1e","1f","20","21","22","23","24","25","26","27","28","29","2a","2b","2c","2d","2e","2f","30","31","32","33","34","35","36","37","38","39","3a","3b","3c","3d","3e","3f","40","41","42","43","44","45","46","47","48","49","4a","4b","4c","4d","4e","4f","50","51","52","53","54","55","56","57","58","59","5a","5b","5c","5d","5e","5f","60","61","62","63","64","65","66","67","68","69","6a","6b","6c","6d","6e","6f","70","71","72","73","74","75","76","77","78","79","7a","7b","7c","7d","7e","7f","80","81","82","83","84","85","86","87","88","89","8a","8b","8c","8d","8e","8f","90","91","92","93","94","95","96","97","98","99","9a","9b","9c","9d","9e","9f","a0","a1","a2","a3","a4","a5","a6","a7","a8","a9","aa","ab","ac","ad","ae","af","b0","b1","b2","b3","b4","b5","b6","b7","b8","b9","ba","bb","bc","bd","be","bf","c0","c1","c2","c3","c4","c5","c6","c7","c8","c9","ca","cb","cc","cd","ce","cf","d0","d1","d2","d3","d4","d5","d6","d7","d8","d9","da","db","dc","dd","de","df","e0","e1","e2","e3","e4","e5","e6","e7","e8","e9","ea","eb","ec","ed","ee","ef","f0","f1","f2","f3","f4","f5","f6","f7","f8","f9","fa","fb","fc","fd","fe","ff"],Rf=1234567,qr=Math.PI/180,Ws=180/Math.PI;function qi(){let i=Math.random()*4294967295|0,e=Math.random()*4294967295|0,t=Math.random()*4294967295|0,n=Math.random()*4294967295|0;return(tn[i&255]+tn[i>>8&255]+tn[i>>16&255]+tn[i>>24&255]+"-"+tn[e&255]+tn[e>>8&255]+"-"+tn[e>>16&15|64]+tn[e>>24&255]+"-"+tn[t&63|128]+tn[t>>8&255]+"-"+tn[t>>16&255]+tn[t>>24&255]+tn[n&255]+tn[n>>8&255]+tn[n>>16&255]+tn[n>>24&255]).toLowerCase()}function Ve(i,e,t){return Math.max(e,Math.min(t,i))}function qu(i,e){return(i%e+e)%e}function Sy(i,e,t,n,s){return n+(i-e)*(s-n)/(t-e)}function wy(i,e,t){return i!==e?(t-i)/(e-i):0}function $r(i,e,t){return(1-t)*i+t*e}function Ty(i,e,t,n){return $r(i,e,1-Math.exp(-t*n))}function Ay(i,e=1){return e-Math.abs(qu(i,e*2)-e)}function Ey(i,e,t){return i<=e?0:i>=t?1:(i=(i-e)/(t-e),i*i*(3-2*i))}function Cy(i,e,t){return i<=e?0:i>=t?1:(i=(i-e)/(t-e),i*i*i*(i*(i*6-15)+10))}function Ry(i,e){return i+Math.floor(Math.random()*(e-i+1))}function Py(i,e){return i+Math.random()*(e-i)}function Iy(i){return i*(.5-Math.random())}function Ly(i){i!==void 0&&(Rf=i);let e=Rf+=1831565813;return e=Math.imul(e^e>>>15,e|1),e^=e+Math.imul(e^e>>>7,e|61),((e^e>>>14)>>>0)/4294967296}function Ny(i){return i*qr}function Dy(i){return i*Ws}function Oy(i){return i>0&&Number.isInteger(i)&&2**Math.round(Math.log2(i))===i}function Uy(i){return Math.pow(2,Math.ceil(Math.log(i)/Math.LN2))}function $u(i){return Math.pow(2,Math.floor(Math.log(i)/Math.LN2))}function Fy(i,e,t,n,s){let r=Math.cos,o=Math.sin,a=r(t/2),l=o(t/2),c=r((e+n)/2),h=o((e+n)/2),u=r((e-n)/2),d=o((e-n)/2),f=r((n-e)/2),p=o((n-e)/2);switch(s){case"XYX":i.set(a*h,l*u,l*d,a*c);break;case"YZY":i.set(l*d,a*h,l*u,a*c);break;case"ZXZ":i.set(l*u,l*d,a*h,a*c);break;case"XZX":i.set(a*h,l*p,l*f,a*c);break;case"YXY":i.set(l*f,a*h,l*p,a*c);break;case"ZYZ":i.set(l*p,l*f,a*h,a*c);break;default:Re("MathUtils: .setQuaternionFromProperEuler() encountered an unknown order: "+s)}}function Jl(i){switch(i.constructor){case Uint32Array:return 4294967295;case Uint16Array:return 65535;case Uint8Array:case Uint8ClampedArray:return 255;case Int32Array:return 2147483647;case Int16Array:return 32767;case Int8Array:return 127;default:return}}function Yu(i,e){if(e.constructor===Float32Array)return i;let t=Jl(e);if(t===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.max(i/t,-1)}function ju(i,e){if(e.constructor===Float32Array)return i;let t=Jl(e);if(t===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.round(i*t)}var ei={DEG2RAD:qr,RAD2DEG:Ws,generateUUID:qi,clamp:Ve,euclideanModulo:qu,mapLinear:Sy,inverseLerp:wy,lerp:$r,damp:Ty,pingpong:Ay,smoothstep:Ey,smootherstep:Cy,randInt:Ry,randFloat:Py,randFloatSpread:Iy,seededRandom:Ly,degToRad:Ny,radToDeg:Dy,isPowerOfTwo:Oy,ceilPowerOfTwo:Uy,floorPowerOfTwo:$u,setQuaternionFromProperEuler:Fy,normalize:ju,denormalize:Yu},_e=class{static{this.prototype.isVector2=!0}constructor(e=0,t=0){this.x=e,this.y=t}get width(){return this.x}set width(e){this.x=e}get height(){return this.y}set height(e){this.y=e}set(e,t){return this.x=e,this.y=t,this}setScalar(e){return this.x=e,this.y=e,this}setX(e){return this.x=e,this}setY(e){return this.y=e,this}setComponent(e,t){switch(e){case 0:this.x=t;break;case 1:this.y=t;break;default:throw new Error("THREE.Vector2: index is out of range: "+e)}return this}getComponent(e){switch(e){case 0:return this.x;case 1:return this.y;default:throw new Error("THREE.Vector2: index is out of range: "+e)}}clone(){return new this.constructor(this.x,this.y)}copy(e){return this.x=e.x,this.y=e.y,this}add(e){return this.x+=e.x,this.y+=e.y,this}addScalar(e){return this.x+=e,this.y+=e,this}addVectors(e,t){return this.x=e.x+t.x,this.y=e.y+t.y,this}addScaledVector(e,t){return this.x+=e.x*t,this.y+=e.y*t,this}sub(e){return this.x-=e.x,this.y-=e.y,this}subScalar(e){return this.x-=e,this.y-=e,this}subVectors(e,t){return this.x=e.x-t.x,this.y=e.y-t.y,this}multiply(e){return this.x*=e.x,this.y*=e.y,this}multiplyScalar(e){return this.x*=e,this.y*=e,this}divide(e){return this.x/=e.x,this.y/=e.y,this}divideScalar(e){return this.multiplyScalar(1/e)}applyMatrix3(e){let t=this.x,n=this.y,s=e.elements;return this.x=s[0]*t+s[3]*n+s[6],this.y=s[1]*t+s[4]*n+s[7],this}min(e){return this.x=Math.min(this.x,e.x),this.y=Math.min(this.y,e.y),this}max(e){return this.x=Math.max(this.x,e.x),this.y=Math.max(this.y,e.y),this}clamp(e,t){return this.x=Ve(this.x,e.x,t.x),this.y=Ve(this.y,e.y,t.y),this}clampScalar(e,t){return this.x=Ve(this.x,e,t),this.y=Ve(this.y,e,t),this}clampLength(e,t){let n=this.length();return this.divideScalar(n||1).multiplyScalar(Ve(n,e,t))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this}negate(){return this.x=-this.x,this.y=-this.y,this}dot(e){return this.x*e.x+this.y*e.y}cross(e){return this.x*e.y-this.y*e.x}lengthSq(){return this.x*this.x+this.y*this.y}length(){return Math.sqrt(this.x*this.x+this.y*this.y)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)}normalize(){return this.divideScalar(this.length()||1)}angle(){return Math.atan2(-this.y,-this.x)+Math.PI}angleTo(e){let t=Math.sqrt(this.lengthSq()*e.lengthSq());if(t===0)return Math.PI/2;let n=this.dot(e)/t;return Math.acos(Ve(n,-1,1))}distanceTo(e){return Math.sqrt(this.distanceToSquared(e))}distanceToSquared(e){let t=this.x-e.x,n=this.y-e.y;return t*t+n*n}manhattanDistanceTo(e){return Math.abs(this.x-e.x)+Math.abs(this.y-e.y)}setLength(e){return this.normalize().multiplyScalar(e)}lerp(e,t){return this.x+=(e.x-this.x)*t,this.y+=(e.y-this.y)*t,this}lerpVectors(e,t,n){return this.x=e.x+(t.x-e.x)*n,this.y=e.y+(t.y-e.y)*n,this}equals(e){return e.x===this.x&&e.y===this.y}fromArray(e,t=0){return this.x=e[t],this.y=e[t+1],this}toArray(e=[],t=0){return e[t]=this.x,e[t+1]=this.y,e}fromBufferAttribute(e,t){return this.x=e.getX(t),this.y=e.getY(t),this}rotateAround(e,t){let n=Math.cos(t),s=Math.sin(t),r=this.x-e.x,o=this.y-e.y;return this.x=r*n-o*s+e.x,this.y=r*s+o*n+e.y,this}random(){return this.x=Math.random(),this.y=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y}},jt=class{constructor(e=0,t=0,n=0,s=1){this.isQuaternion=!0,this._x=e,this._y=t,this._z=n,this._w=s}static slerpFlat(e,t,n,s,r,o,a){let l=n[s+0],c=n[s+1],h=n[s+2],u=n[s+3],d=r[o+0],f=r[o+1],p=r[o+2],v=r[o+3];if(u!==v||l!==d||c!==f||h!==p){let m=l*d+c*f+h*p+u*v;m<0&&(d=-d,f=-f,p=-p,v=-v,m=-m);let g=1-a;if(m<.9995){let x=Math.acos(m),b=Math.sin(x);g=Math.sin(g*x)/b,a=Math.sin(a*x)/b,l=l*g+d*a,c=c*g+f*a,h=h*g+p*a,u=u*g+v*a}else{l=l*g+d*a,c=c*g+f*a,h=h*g+p*a,u=u*g+v*a;let x=1/Math.sqrt(l*l+c*c+h*h+u*u);l*=x,c*=x,h*=x,u*=x}}e[t]=l,e[t+1]=c,e[t+2]=h,e[t+3]=u}static multiplyQuaternionsFlat(e,t,n,s,r,o){let a=n[s],l=n[s+1],c=n[s+2],h=n[s+3],u=r[o],d=r[o+1],f=r[o+2],p=r[o+3];return e[t]=a*p+h*u+l*f-c*d,e[t+1]=l*p+h*d+c*u-a*f,e[t+2]=c*p+h*f+a*d-l*u,e[t+3]=h*p-a*u-l*d-c*f,e}get x(){return this._x}set x(e){this._x=e,this._onChangeCallback()}get y(){return this._y}set y(e){this._y=e,this._onChangeCallback()}get z(){return this._z}set z(e){this._z=e,this._onChangeCallback()}get w(){return this._w}set w(e){this._w=e,this._onChangeCallback()}set(e,t,n,s){return this._x=e,this._y=t,this._z=n,this._w=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._w)}copy(e){return this._x=e.x,this._y=e.y,this._z=e.z,this._w=e.w,this._onChangeCallback(),this}setFromEuler(e,t=!0){let n=e._x,s=e._y,r=e._z,o=e._order,a=Math.cos,l=Math.sin,c=a(n/2),h=a(s/2),u=a(r/2),d=l(n/2),f=l(s/2),p=l(r/2);switch(o){case"XYZ":this._x=d*h*u+c*f*p,this._y=c*f*u-d*h*p,this._z=c*h*p+d*f*u,this._w=c*h*u-d*f*p;break;case"YXZ":this._x=d*h*u+c*f*p,this._y=c*f*u-d*h*p,this._z=c*h*p-d*f*u,this._w=c*h*u+d*f*p;break;case"ZXY":this._x=d*h*u-c*f*p,this._y=c*f*u+d*h*p,this._z=c*h*p+d*f*u,this._w=c*h*u-d*f*p;break;case"ZYX":this._x=d*h*u-c*f*p,this._y=c*f*u+d*h*p,this._z=c*h*p-d*f*u,this._w=c*h*u+d*f*p;break;case"YZX":this._x=d*h*u+c*f*p,this._y=c*f*u+d*h*p,this._z=c*h*p-d*f*u,this._w=c*h*u-d*f*p;break;case"XZY":this._x=d*h*u-c*f*p,this._y=c*f*u-d*h*p,this._z=c*h*p+d*f*u,this._w=c*h*u+d*f*p;break;default:Re("Quaternion: .setFromEuler() encountered an unknown order: "+o)}return t===!0&&this._onChangeCallback(),this}setFromAxisAngle(e,t){let n=t/2,s=Math.sin(n);return this._x=e.x*s,this._y=e.y*s,this._z=e.z*s,this._w=Math.cos(n),this._onChangeCallback(),this}setFromRotationMatrix(e){let t=e.elements,n=t[0],s=t[4],r=t[8],o=t[1],a=t[5],l=t[9],c=t[2],h=t[6],u=t[10],d=n+a+u;if(d>0){let f=.5/Math.sqrt(d+1);this._w=.25/f,this._x=(h-l)*f,this._y=(r-c)*f,this._z=(o-s)*f}else if(n>a&&n>u){let f=2*Math.sqrt(1+n-a-u);this._w=(h-l)/f,this._x=.25*f,this._y=(s+o)/f,this._z=(r+c)/f}else if(a>u){let f=2*Math.sqrt(1+a-n-u);this._w=(r-c)/f,this._x=(s+o)/f,this._y=.25*f,this._z=(l+h)/f}else{let f=2*Math.sqrt(1+u-n-a);this._w=(o-s)/f,this._x=(r+c)/f,this._y=(l+h)/f,this._z=.25*f}return this._onChangeCallback(),this}setFromUnitVectors(e,t){let n=e.dot(t)+1;return n<1e-8?(n=0,Math.abs(e.x)>Math.abs(e.z)?(this._x=-e.y,this._y=e.x,this._z=0,this._w=n):(this._x=0,this._y=-e.z,this._z=e.y,this._w=n)):(this._x=e.y*t.z-e.z*t.y,this._y=e.z*t.x-e.x*t.z,this._z=e.x*t.y-e.y*t.x,this._w=n),this.normalize()}angleTo(e){return 2*Math.acos(Math.abs(Ve(this.dot(e),-1,1)))}rotateTowards(e,t){let n=this.angleTo(e);if(n===0)return this;let s=Math.min(1,t/n);return this.slerp(e,s),this}identity(){return this.set(0,0,0,1)}invert(){return this.conjugate()}conjugate(){return this._x*=-1,this._y*=-1,this._z*=-1,this._onChangeCallback(),this}dot(e){return this._x*e._x+this._y*e._y+this._z*e._z+this._w*e._w}lengthSq(){return this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w}length(){return Math.sqrt(this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w)}normalize(){let e=this.length();return e===0?(this._x=0,this._y=0,this._z=0,this._w=1):(e=1/e,this._x=this._x*e,this._y=this._y*e,this._z=this._z*e,this._w=this._w*e),this._onChangeCallback(),this}multiply(e){return this.multiplyQuaternions(this,e)}premultiply(e){return this.multiplyQuaternions(e,this)}multiplyQuaternions(e,t){let n=e._x,s=e._y,r=e._z,o=e._w,a=t._x,l=t._y,c=t._z,h=t._w;return this._x=n*h+o*a+s*c-r*l,this._y=s*h+o*l+r*a-n*c,this._z=r*h+o*c+n*l-s*a,this._w=o*h-n*a-s*l-r*c,this._onChangeCallback(),this}slerp(e,t){let n=e._x,s=e._y,r=e._z,o=e._w,a=this.dot(e);a<0&&(n=-n,s=-s,r=-r,o=-o,a=-a);let l=1-t;if(a<.9995){let c=Math.acos(a),h=Math.sin(c);l=Math.sin(l*c)/h,t=Math.sin(t*c)/h,this._x=this._x*l+n*t,this._y=this._y*l+s*t,this._z=this._z*l+r*t,this._w=this._w*l+o*t,this._onChangeCallback()}else this._x=this._x*l+n*t,this._y=this._y*l+s*t,this._z=this._z*l+r*t,this._w=this._w*l+o*t,this.normalize();return this}slerpQuaternions(e,t,n){return this.copy(e).slerp(t,n)}random(){let e=2*Math.PI*Math.random(),t=2*Math.PI*Math.random(),n=Math.random(),s=Math.sqrt(1-n),r=Math.sqrt(n);return this.set(s*Math.sin(e),s*Math.cos(e),r*Math.sin(t),r*Math.cos(t))}equals(e){return e._x===this._x&&e._y===this._y&&e._z===this._z&&e._w===this._w}fromArray(e,t=0){return this._x=e[t],this._y=e[t+1],this._z=e[t+2],this._w=e[t+3],this._onChangeCallback(),this}toArray(e=[],t=0){return e[t]=this._x,e[t+1]=this._y,e[t+2]=this._z,e[t+3]=this._w,e}fromBufferAttribute(e,t){return this._x=e.getX(t),this._y=e.getY(t),this._z=e.getZ(t),this._w=e.getW(t),this._onChangeCallback(),this}toJSON(){return this.toArray()}_onChange(e){return this._onChangeCallback=e,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._w}},C=class{static{this.prototype.isVector3=!0}constructor(e=0,t=0,n=0){this.x=e,this.y=t,this.z=n}set(e,t,n){return n===void 0&&(n=this.z),this.x=e,this.y=t,this.z=n,this}setScalar(e){return this.x=e,this.y=e,this.z=e,this}setX(e){return this.x=e,this}setY(e){return this.y=e,this}setZ(e){return this.z=e,this}setComponent(e,t){switch(e){case 0:this.x=t;break;case 1:this.y=t;break;case 2:this.z=t;break;default:throw new Error("THREE.Vector3: index is out of range: "+e)}return this}getComponent(e){switch(e){case 0:return this.x;case 1:return this.y;case 2:return this.z;default:throw new Error("THREE.Vector3: index is out of range: "+e)}}clone(){return new this.constructor(this.x,this.y,this.z)}copy(e){return this.x=e.x,this.y=e.y,this.z=e.z,this}add(e){return this.x+=e.x,this.y+=e.y,this.z+=e.z,this}addScalar(e){return this.x+=e,this.y+=e,this.z+=e,this}addVectors(e,t){return this.x=e.x+t.x,this.y=e.y+t.y,this.z=e.z+t.z,this}addScaledVector(e,t){return this.x+=e.x*t,this.y+=e.y*t,this.z+=e.z*t,this}sub(e){return this.x-=e.x,this.y-=e.y,this.z-=e.z,this}subScalar(e){return this.x-=e,this.y-=e,this.z-=e,this}subVectors(e,t){return this.x=e.x-t.x,this.y=e.y-t.y,this.z=e.z-t.z,this}multiply(e){return this.x*=e.x,this.y*=e.y,this.z*=e.z,this}multiplyScalar(e){return this.x*=e,this.y*=e,this.z*=e,this}multiplyVectors(e,t){return this.x=e.x*t.x,this.y=e.y*t.y,this.z=e.z*t.z,this}applyEuler(e){return this.applyQuaternion(Pf.setFromEuler(e))}applyAxisAngle(e,t){return this.applyQuaternion(Pf.setFromAxisAngle(e,t))}applyMatrix3(e){let t=this.x,n=this.y,s=this.z,r=e.elements;return this.x=r[0]*t+r[3]*n+r[6]*s,this.y=r[1]*t+r[4]*n+r[7]*s,this.z=r[2]*t+r[5]*n+r[8]*s,this}applyNormalMatrix(e){return this.applyMatrix3(e).normalize()}applyMatrix4(e){let t=this.x,n=this.y,s=this.z,r=e.elements,o=1/(r[3]*t+r[7]*n+r[11]*s+r[15]);return this.x=(r[0]*t+r[4]*n+r[8]*s+r[12])*o,this.y=(r[1]*t+r[5]*n+r[9]*s+r[13])*o,this.z=(r[2]*t+r[6]*n+r[10]*s+r[14])*o,this}applyQuaternion(e){let t=this.x,n=this.y,s=this.z,r=e.x,o=e.y,a=e.z,l=e.w,c=2*(o*s-a*n),h=2*(a*t-r*s),u=2*(r*n-o*t);return this.x=t+l*c+o*u-a*h,this.y=n+l*h+a*c-r*u,this.z=s+l*u+r*h-o*c,this}project(e){return this.applyMatrix4(e.matrixWorldInverse).applyMatrix4(e.projectionMatrix)}unproject(e){return this.applyMatrix4(e.projectionMatrixInverse).applyMatrix4(e.matrixWorld)}transformDirection(e){let t=this.x,n=this.y,s=this.z,r=e.elements;return this.x=r[0]*t+r[4]*n+r[8]*s,this.y=r[1]*t+r[5]*n+r[9]*s,this.z=r[2]*t+r[6]*n+r[10]*s,this.normalize()}divide(e){return this.x/=e.x,this.y/=e.y,this.z/=e.z,this}divideScalar(e){return this.multiplyScalar(1/e)}min(e){return this.x=Math.min(this.x,e.x),this.y=Math.min(this.y,e.y),this.z=Math.min(this.z,e.z),this}max(e){return this.x=Math.max(this.x,e.x),this.y=Math.max(this.y,e.y),this.z=Math.max(this.z,e.z),this}clamp(e,t){return this.x=Ve(this.x,e.x,t.x),this.y=Ve(this.y,e.y,t.y),this.z=Ve(this.z,e.z,t.z),this}clampScalar(e,t){return this.x=Ve(this.x,e,t),this.y=Ve(this.y,e,t),this.z=Ve(this.z,e,t),this}clampLength(e,t){let n=this.length();return this.divideScalar(n||1).multiplyScalar(Ve(n,e,t))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this}dot(e){return this.x*e.x+this.y*e.y+this.z*e.z}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)}normalize(){return this.divideScalar(this.length()||1)}setLength(e){return this.normalize().multiplyScalar(e)}lerp(e,t){return this.x+=(e.x-this.x)*t,this.y+=(e.y-this.y)*t,this.z+=(e.z-this.z)*t,this}lerpVectors(e,t,n){return this.x=e.x+(t.x-e.x)*n,this.y=e.y+(t.y-e.y)*n,this.z=e.z+(t.z-e.z)*n,this}cross(e){return this.crossVectors(this,e)}crossVectors(e,t){let n=e.x,s=e.y,r=e.z,o=t.x,a=t.y,l=t.z;return this.x=s*l-r*a,this.y=r*o-n*l,this.z=n*a-s*o,this}projectOnVector(e){let t=e.lengthSq();if(t===0)return this.set(0,0,0);let n=e.dot(this)/t;return this.copy(e).multiplyScalar(n)}projectOnPlane(e){return Oh.copy(this).projectOnVector(e),this.sub(Oh)}reflect(e){return this.sub(Oh.copy(e).multiplyScalar(2*this.dot(e)))}angleTo(e){let t=Math.sqrt(this.lengthSq()*e.lengthSq());if(t===0)return Math.PI/2;let n=this.dot(e)/t;return Math.acos(Ve(n,-1,1))}distanceTo(e){return Math.sqrt(this.distanceToSquared(e))}distanceToSquared(e){let t=this.x-e.x,n=this.y-e.y,s=this.z-e.z;return t*t+n*n+s*s}manhattanDistanceTo(e){return Math.abs(this.x-e.x)+Math.abs(this.y-e.y)+Math.abs(this.z-e.z)}setFromSpherical(e){return this.setFromSphericalCoords(e.radius,e.phi,e.theta)}setFromSphericalCoords(e,t,n){let s=Math.sin(t)*e;return this.x=s*Math.sin(n),this.y=Math.cos(t)*e,this.z=s*Math.cos(n),this}setFromCylindrical(e){return this.setFromCylindricalCoords(e.radius,e.theta,e.y)}setFromCylindricalCoords(e,t,n){return this.x=e*Math.sin(t),this.y=n,this.z=e*Math.cos(t),this}setFromMatrixPosition(e){let t=e.elements;return this.x=t[12],this.y=t[13],this.z=t[14],this}setFromMatrixScale(e){let t=this.setFromMatrixColumn(e,0).length(),n=this.setFromMatrixColumn(e,1).length(),s=this.setFromMatrixColumn(e,2).length();return this.x=t,this.y=n,this.z=s,this}setFromMatrixColumn(e,t){return this.fromArray(e.elements,t*4)}setFromMatrix3Column(e,t){return this.fromArray(e.elements,t*3)}setFromEuler(e){return this.x=e._x,this.y=e._y,this.z=e._z,this}setFromColor(e){return this.x=e.r,this.y=e.g,this.z=e.b,this}equals(e){return e.x===this.x&&e.y===this.y&&e.z===this.z}fromArray(e,t=0){return this.x=e[t],this.y=e[t+1],this.z=e[t+2],this}toArray(e=[],t=0){return e[t]=this.x,e[t+1]=this.y,e[t+2]=this.z,e}fromBufferAttribute(e,t){return this.x=e.getX(t),this.y=e.getY(t),this.z=e.getZ(t),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this}randomDirection(){let e=Math.random()*Math.PI*2,t=Math.random()*2-1,n=Math.sqrt(1-t*t);return this.x=n*Math.cos(e),this.y=t,this.z=n*Math.sin(e),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z}},Oh=new C,Pf=new jt,Ue=class{static{this.prototype.isMatrix3=!0}constructor(e,t,n,s,r,o,a,l,c){this.elements=[1,0,0,0,1,0,0,0,1],e!==void 0&&this.set(e,t,n,s,r,o,a,l,c)}set(e,t,n,s,r,o,a,l,c){let h=this.elements;return h[0]=e,h[1]=s,h[2]=a,h[3]=t,h[4]=r,h[5]=l,h[6]=n,h[7]=o,h[8]=c,this}identity(){return this.set(1,0,0,0,1,0,0,0,1),this}copy(e){let t=this.elements,n=e.elements;return t[0]=n[0],t[1]=n[1],t[2]=n[2],t[3]=n[3],t[4]=n[4],t[5]=n[5],t[6]=n[6],t[7]=n[7],t[8]=n[8],this}extractBasis(e,t,n){return e.setFromMatrix3Column(this,0),t.setFromMatrix3Column(this,1),n.setFromMatrix3Column(this,2),this}setFromMatrix4(e){let t=e.elements;return this.set(t[0],t[4],t[8],t[1],t[5],t[9],t[2],t[6],t[10]),this}multiply(e){return this.multiplyMatrices(this,e)}premultiply(e){return this.multiplyMatrices(e,this)}multiplyMatrices(e,t){let n=e.elements,s=t.elements,r=this.elements,o=n[0],a=n[3],l=n[6],c=n[1],h=n[4],u=n[7],d=n[2],f=n[5],p=n[8],v=s[0],m=s[3],g=s[6],x=s[1],b=s[4],_=s[7],M=s[2],A=s[5],y=s[8];return r[0]=o*v+a*x+l*M,r[3]=o*m+a*b+l*A,r[6]=o*g+a*_+l*y,r[1]=c*v+h*x+u*M,r[4]=c*m+h*b+u*A,r[7]=c*g+h*_+u*y,r[2]=d*v+f*x+p*M,r[5]=d*m+f*b+p*A,r[8]=d*g+f*_+p*y,this}multiplyScalar(e){let t=this.elements;return t[0]*=e,t[3]*=e,t[6]*=e,t[1]*=e,t[4]*=e,t[7]*=e,t[2]*=e,t[5]*=e,t[8]*=e,this}determinant(){let e=this.elements,t=e[0],n=e[1],s=e[2],r=e[3],o=e[4],a=e[5],l=e[6],c=e[7],h=e[8];return t*o*h-t*a*c-n*r*h+n*a*l+s*r*c-s*o*l}invert(){let e=this.elements,t=e[0],n=e[1],s=e[2],r=e[3],o=e[4],a=e[5],l=e[6],c=e[7],h=e[8],u=h*o-a*c,d=a*l-h*r,f=c*r-o*l,p=t*u+n*d+s*f;if(p===0)return this.set(0,0,0,0,0,0,0,0,0);let v=1/p;return e[0]=u*v,e[1]=(s*c-h*n)*v,e[2]=(a*n-s*o)*v,e[3]=d*v,e[4]=(h*t-s*l)*v,e[5]=(s*r-a*t)*v,e[6]=f*v,e[7]=(n*l-c*t)*v,e[8]=(o*t-n*r)*v,this}transpose(){let e,t=this.elements;return e=t[1],t[1]=t[3],t[3]=e,e=t[2],t[2]=t[6],t[6]=e,e=t[5],t[5]=t[7],t[7]=e,this}getNormalMatrix(e){return this.setFromMatrix4(e).invert().transpose()}transposeIntoArray(e){let t=this.elements;return e[0]=t[0],e[1]=t[3],e[2]=t[6],e[3]=t[1],e[4]=t[4],e[5]=t[7],e[6]=t[2],e[7]=t[5],e[8]=t[8],this}setUvTransform(e,t,n,s,r,o,a){let l=Math.cos(r),c=Math.sin(r);return this.set(n*l,n*c,-n*(l*o+c*a)+o+e,-s*c,s*l,-s*(-c*o+l*a)+a+t,0,0,1),this}scale(e,t){return Xr("Matrix3: .scale() is deprecated. Use .makeScale() instead."),this.premultiply(Uh.makeScale(e,t)),this}rotate(e){return Xr("Matrix3: .rotate() is deprecated. Use .makeRotation() instead."),this.premultiply(Uh.makeRotation(-e)),this}translate(e,t){return Xr("Matrix3: .translate() is deprecated. Use .makeTranslation() instead."),this.premultiply(Uh.makeTranslation(e,t)),this}makeTranslation(e,t){return e.isVector2?this.set(1,0,e.x,0,1,e.y,0,0,1):this.set(1,0,e,0,1,t,0,0,1),this}makeRotation(e){let t=Math.cos(e),n=Math.sin(e);return this.set(t,-n,0,n,t,0,0,0,1),this}makeScale(e,t){return this.set(e,0,0,0,t,0,0,0,1),this}equals(e){let t=this.elements,n=e.elements;for(let s=0;s<9;s++)if(t[s]!==n[s])return!1;return!0}fromArray(e,t=0){for(let n=0;n<9;n++)this.elements[n]=e[n+t];return this}toArray(e=[],t=0){let n=this.elements;return e[t]=n[0],e[t+1]=n[1],e[t+2]=n[2],e[t+3]=n[3],e[t+4]=n[4],e[t+5]=n[5],e[t+6]=n[6],e[t+7]=n[7],e[t+8]=n[8],e}clone(){return new this.constructor().fromArray(this.elements)}},Uh=new Ue,If=new Ue().set(.4123908,.3575843,.1804808,.212639,.7151687,.0721923,.0193308,.1191948,.9505322),Lf=new Ue().set(3.2409699,-1.5373832,-.4986108,-.9692436,1.8759675,.0415551,.0556301,-.203977,1.0569715);function By(){let i={enabled:!0,workingColorSpace:jr,spaces:{},convert:function(s,r,o){return this.enabled===!1||r===o||!r||!o||(this.spaces[r].transfer===ht&&(s.r=Si(s.r),s.g=Si(s.g),s.b=Si(s.b)),this.spaces[r].primaries!==this.spaces[o].primaries&&(s.applyMatrix3(this.spaces[r].toXYZ),s.applyMatrix3(this.spaces[o].fromXYZ)),this.spaces[o].transfer===ht&&(s.r=Vs(s.r),s.g=Vs(s.g),s.b=Vs(s.b))),s},workingToColorSpace:function(s,r){return this.convert(s,this.workingColorSpace,r)},colorSpaceToWorking:function(s,r){return this.convert(s,r,this.workingColorSpace)},getPrimaries:function(s){return this.spaces[s].primaries},getTransfer:function(s){return s===Ri?Zr:this.spaces[s].transfer},getToneMappingMode:function(s){return this.spaces[s].outputColorSpaceConfig.toneMappingMode||"standard"},getLuminanceCoefficients:function(s,r=this.workingColorSpace){return s.fromArray(this.spaces[r].luminanceCoefficients)},define:function(s){Object.assign(this.spaces,s)},_getMatrix:function(s,r,o){return s.copy(this.spaces[o].fromXYZ).multiply(this.spaces[r].toXYZ)},_getDrawingBufferColorSpace:function(s){return this.spaces[s].outputColorSpaceConfig.drawingBufferColorSpace},_getUnpackColorSpace:function(s=this.workingColorSpace){return this.spaces[s].workingColorSpaceConfig.unpackColorSpace}},e=[.64,.33,.3,.6,.15,.06],t=[.2126,.7152,.0722],n=[.3127,.329];return i.define({[jr]:{primaries:e,whitePoint:n,transfer:Zr,toXYZ:If,fromXYZ:Lf,luminanceCoefficients:t,workingColorSpaceConfig:{unpackColorSpace:dn},outputColorSpaceConfig:{drawingBufferColorSpace:dn}},[dn]:{primaries:e,whitePoint:n,transfer:ht,toXYZ:If,fromXYZ:Lf,luminanceCoefficients:t,outputColorSpaceConfig:{drawingBufferColorSpace:dn}}}),i}var $e=By();function Si(i){return i<.04045?i*.0773993808:Math.pow(i*.9478672986+.0521327014,2.4)}function Vs(i){return i<.0031308?i*12.92:1.055*Math.pow(i,.41666)-.055}var Ms,qa=class{static getDataURL(e,t="image/png"){if(/^data:/i.test(e.src)||typeof HTMLCanvasElement>"u")return e.src;let n;if(e instanceof HTMLCanvasElement)n=e;else{Ms===void 0&&(Ms=Kr("canvas")),Ms.width=e.width,Ms.height=e.height;let s=Ms.getContext("2d");e instanceof ImageData?s.putImageData(e,0,0):s.drawImage(e,0,0,e.width,e.height),n=Ms}return n.toDataURL(t)}static sRGBToLinear(e){if(typeof HTMLImageElement<"u"&&e instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&e instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&e instanceof ImageBitmap){let t=Kr("canvas");t.width=e.width,t.height=e.height;let n=t.getContext("2d");n.drawImage(e,0,0,e.width,e.height);let s=n.getImageData(0,0,e.width,e.height),r=s.data;for(let o=0;o<r.length;o++)r[o]=Si(r[o]/255)*255;return n.putImageData(s,0,0),t}else if(e.data){let t=e.data.slice(0);for(let n=0;n<t.length;n++)t instanceof Uint8Array||t instanceof Uint8ClampedArray?t[n]=Math.floor(Si(t[n]/255)*255):t[n]=Si(t[n]);return{data:t,width:e.width,height:e.height}}else return Re("ImageUtils.sRGBToLinear(): Unsupported image type. No color space conversion applied."),e}},ky=0,Xs=class{constructor(e=null){this.isTextureSource=!0,Object.defineProperty(this,"id",{value:ky++}),this.uuid=qi(),this.data=e,this.dataReady=!0,this.version=0}getSize(e){let t=this.data;return typeof HTMLVideoElement<"u"&&t instanceof HTMLVideoElement?e.set(t.videoWidth,t.videoHeight,0):typeof VideoFrame<"u"&&t instanceof VideoFrame?e.set(t.displayWidth,t.displayHeight,0):t!==null?e.set(t.width||0,t.height||0,t.depth||0):e.set(0,0,0),e}set needsUpdate(e){e===!0&&this.version++}toJSON(e){let t=e===void 0||typeof e=="string";if(!t&&e.images[this.uuid]!==void 0)return e.images[this.uuid];let n={uuid:this.uuid,url:""},s=this.data;if(s!==null){let r;if(Array.isArray(s)){r=[];for(let o=0,a=s.length;o<a;o++)s[o].isDataTexture?r.push(Fh(s[o].image)):r.push(Fh(s[o]))}else r=Fh(s);n.url=r}return t||(e.images[this.uuid]=n),n}};function Fh(i){return typeof HTMLImageElement<"u"&&i instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&i instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&i instanceof ImageBitmap?qa.getDataURL(i):i.data?{data:Array.from(i.data),width:i.width,height:i.height,type:i.data.constructor.name}:(Re("Texture: Unable to serialize Texture."),{})}var zy=0,Bh=new C,mn=class i extends li{constructor(e=i.DEFAULT_IMAGE,t=i.DEFAULT_MAPPING,n=ai,s=ai,r=pn,o=Ei,a=Rn,l=vn,c=i.DEFAULT_ANISOTROPY,h=Ri){super(),this.isTexture=!0,Object.defineProperty(this,"id",{value:zy++}),this.uuid=qi(),this.name="",this.source=new Xs(e),this.mipmaps=[],this.mapping=t,this.channel=0,this.wrapS=n,this.wrapT=s,this.magFilter=r,this.minFilter=o,this.anisotropy=c,this.format=a,this.internalFormat=null,this.type=l,this.offset=new _e(0,0),this.repeat=new _e(1,1),this.center=new _e(0,0),this.rotation=0,this.matrixAutoUpdate=!0,this.matrix=new Ue,this.generateMipmaps=!0,this.mipmapsAutoUpdate=!0,this.premultiplyAlpha=!1,this.flipY=!0,this.unpackAlignment=4,this.colorSpace=h,this.userData={},this.updateRanges=[],this.version=0,this.onUpdate=null,this.renderTarget=null,this.isRenderTargetTexture=!1,this.isArrayTexture=!!(e&&e.depth&&e.depth>1),this.pmremVersion=0,this.isPMREMTexture=!1,this.normalized=!1}get width(){return this.source.getSize(Bh).x}get height(){return this.source.getSize(Bh).y}get depth(){return this.source.getSize(Bh).z}get image(){return this.source.data}set image(e){this.source.data=e}updateMatrix(){this.matrix.setUvTransform(this.offset.x,this.offset.y,this.repeat.x,this.repeat.y,this.rotation,this.center.x,this.center.y)}addUpdateRange(e,t){this.updateRanges.push({start:e,count:t})}clearUpdateRanges(){this.updateRanges.length=0}clone(){return new this.constructor().copy(this)}copy(e){return this.name=e.name,this.source=e.source,this.mipmaps=e.mipmaps.slice(0),this.mapping=e.mapping,this.channel=e.channel,this.wrapS=e.wrapS,this.wrapT=e.wrapT,this.magFilter=e.magFilter,this.minFilter=e.minFilter,this.anisotropy=e.anisotropy,this.format=e.format,this.internalFormat=e.internalFormat,this.type=e.type,this.normalized=e.normalized,this.offset.copy(e.offset),this.repeat.copy(e.repeat),this.center.copy(e.center),this.rotation=e.rotation,this.matrixAutoUpdate=e.matrixAutoUpdate,this.matrix.copy(e.matrix),this.generateMipmaps=e.generateMipmaps,this.mipmapsAutoUpdate=e.mipmapsAutoUpdate,this.premultiplyAlpha=e.premultiplyAlpha,this.flipY=e.flipY,this.unpackAlignment=e.unpackAlignment,this.colorSpace=e.colorSpace,this.renderTarget=e.renderTarget,this.isRenderTargetTexture=e.isRenderTargetTexture,this.isPMREMTexture=e.isPMREMTexture,this.isArrayTexture=e.isArrayTexture,this.userData=JSON.parse(JSON.stringify(e.userData)),this.needsUpdate=!0,this}setValues(e){for(let t in e){let n=e[t];if(n===void 0){Re(`Texture.setValues(): parameter '${t}' has value of undefined.`);continue}let s=this[t];if(s===void 0){Re(`Texture.setValues(): property '${t}' does not exist.`);continue}s&&n&&s.isVector2&&n.isVector2||s&&n&&s.isVector3&&n.isVector3||s&&n&&s.isMatrix3&&n.isMatrix3?s.copy(n):this[t]=n}}toJSON(e){let t=e===void 0||typeof e=="string";if(!t&&e.textures[this.uuid]!==void 0)return e.textures[this.uuid];let n={metadata:{version:4.7,type:"Texture",generator:"Texture.toJSON"},uuid:this.uuid,name:this.name,image:this.source.toJSON(e).uuid,mapping:this.mapping,channel:this.channel,repeat:[this.repeat.x,this.repeat.y],offset:[this.offset.x,this.offset.y],center:[this.center.x,this.center.y],rotation:this.rotation,wrap:[this.wrapS,this.wrapT],format:this.format,internalFormat:this.internalFormat,type:this.type,normalized:this.normalized,colorSpace:this.colorSpace,minFilter:this.minFilter,magFilter:this.magFilter,anisotropy:this.anisotropy,flipY:this.flipY,generateMipmaps:this.generateMipmaps,mipmapsAutoUpdate:this.mipmapsAutoUpdate,premultiplyAlpha:this.premultiplyAlpha,unpackAlignment:this.unpackAlignment};return Object.keys(this.userData).length>0&&(n.userData=this.userData),t||(e.textures[this.uuid]=n),n}dispose(){this.dispatchEvent({type:"dispose"})}transformUv(e){if(this.mapping!==Lu)return e;if(e.applyMatrix3(this.matrix),e.x<0||e.x>1)switch(this.wrapS){case Ha:e.x=e.x-Math.floor(e.x);break;case ai:e.x=e.x<0?0:1;break;case Wa:Math.abs(Math.floor(e.x)%2)===1?e.x=Math.ceil(e.x)-e.x:e.x=e.x-Math.floor(e.x);break}if(e.y<0||e.y>1)switch(this.wrapT){case Ha:e.y=e.y-Math.floor(e.y);break;case ai:e.y=e.y<0?0:1;break;case Wa:Math.abs(Math.floor(e.y)%2)===1?e.y=Math.ceil(e.y)-e.y:e.y=e.y-Math.floor(e.y);break}return this.flipY&&(e.y=1-e.y),e}set needsUpdate(e){e===!0&&(this.version++,this.source.needsUpdate=!0)}set needsPMREMUpdate(e){e===!0&&this.pmremVersion++}};mn.DEFAULT_IMAGE=null;mn.DEFAULT_MAPPING=Lu;mn.DEFAULT_ANISOTROPY=1;var Ct=class{static{this.prototype.isVector4=!0}constructor(e=0,t=0,n=0,s=1){this.x=e,this.y=t,this.z=n,this.w=s}get width(){return this.z}set width(e){this.z=e}get height(){return this.w}set height(e){this.w=e}set(e,t,n,s){return this.x=e,this.y=t,this.z=n,this.w=s,this}setScalar(e){return this.x=e,this.y=e,this.z=e,this.w=e,this}setX(e){return this.x=e,this}setY(e){return this.y=e,this}setZ(e){return this.z=e,this}setW(e){return this.w=e,this}setComponent(e,t){switch(e){case 0:this.x=t;break;case 1:this.y=t;break;case 2:this.z=t;break;case 3:this.w=t;break;default:throw new Error("THREE.Vector4: index is out of range: "+e)}return this}getComponent(e){switch(e){case 0:return this.x;case 1:return this.y;case 2:return this.z;case 3:return this.w;default:throw new Error("THREE.Vector4: index is out of range: "+e)}}clone(){return new this.constructor(this.x,this.y,this.z,this.w)}copy(e){return this.x=e.x,this.y=e.y,this.z=e.z,this.w=e.w!==void 0?e.w:1,this}add(e){return this.x+=e.x,this.y+=e.y,this.z+=e.z,this.w+=e.w,this}addScalar(e){return this.x+=e,this.y+=e,this.z+=e,this.w+=e,this}addVectors(e,t){return this.x=e.x+t.x,this.y=e.y+t.y,this.z=e.z+t.z,this.w=e.w+t.w,this}addScaledVector(e,t){return this.x+=e.x*t,this.y+=e.y*t,this.z+=e.z*t,this.w+=e.w*t,this}sub(e){return this.x-=e.x,this.y-=e.y,this.z-=e.z,this.w-=e.w,this}subScalar(e){return this.x-=e,this.y-=e,this.z-=e,this.w-=e,this}subVectors(e,t){return this.x=e.x-t.x,this.y=e.y-t.y,this.z=e.z-t.z,this.w=e.w-t.w,this}multiply(e){return this.x*=e.x,this.y*=e.y,this.z*=e.z,this.w*=e.w,this}multiplyScalar(e){return this.x*=e,this.y*=e,this.z*=e,this.w*=e,this}applyMatrix4(e){let t=this.x,n=this.y,s=this.z,r=this.w,o=e.elements;return this.x=o[0]*t+o[4]*n+o[8]*s+o[12]*r,this.y=o[1]*t+o[5]*n+o[9]*s+o[13]*r,this.z=o[2]*t+o[6]*n+o[10]*s+o[14]*r,this.w=o[3]*t+o[7]*n+o[11]*s+o[15]*r,this}divide(e){return this.x/=e.x,this.y/=e.y,this.z/=e.z,this.w/=e.w,this}divideScalar(e){return this.multiplyScalar(1/e)}setAxisAngleFromQuaternion(e){this.w=2*Math.acos(e.w);let t=Math.sqrt(1-e.w*e.w);return t<1e-4?(this.x=1,this.y=0,this.z=0):(this.x=e.x/t,this.y=e.y/t,this.z=e.z/t),this}setAxisAngleFromRotationMatrix(e){let t,n,s,r,l=e.elements,c=l[0],h=l[4],u=l[8],d=l[1],f=l[5],p=l[9],v=l[2],m=l[6],g=l[10];if(Math.abs(h-d)<.01&&Math.abs(u-v)<.01&&Math.abs(p-m)<.01){if(Math.abs(h+d)<.1&&Math.abs(u+v)<.1&&Math.abs(p+m)<.1&&Math.abs(c+f+g-3)<.1)return this.set(1,0,0,0),this;t=Math.PI;let b=(c+1)/2,_=(f+1)/2,M=(g+1)/2,A=(h+d)/4,y=(u+v)/4,S=(p+m)/4;return b>_&&b>M?b<.01?(n=0,s=.707106781,r=.707106781):(n=Math.sqrt(b),s=A/n,r=y/n):_>M?_<.01?(n=.707106781,s=0,r=.707106781):(s=Math.sqrt(_),n=A/s,r=S/s):M<.01?(n=.707106781,s=.707106781,r=0):(r=Math.sqrt(M),n=y/r,s=S/r),this.set(n,s,r,t),this}let x=Math.sqrt((m-p)*(m-p)+(u-v)*(u-v)+(d-h)*(d-h));return Math.abs(x)<.001&&(x=1),this.x=(m-p)/x,this.y=(u-v)/x,this.z=(d-h)/x,this.w=Math.acos((c+f+g-1)/2),this}setFromMatrixPosition(e){let t=e.elements;return this.x=t[12],this.y=t[13],this.z=t[14],this.w=t[15],this}min(e){return this.x=Math.min(this.x,e.x),this.y=Math.min(this.y,e.y),this.z=Math.min(this.z,e.z),this.w=Math.min(this.w,e.w),this}max(e){return this.x=Math.max(this.x,e.x),this.y=Math.max(this.y,e.y),this.z=Math.max(this.z,e.z),this.w=Math.max(this.w,e.w),this}clamp(e,t){return this.x=Ve(this.x,e.x,t.x),this.y=Ve(this.y,e.y,t.y),this.z=Ve(this.z,e.z,t.z),this.w=Ve(this.w,e.w,t.w),this}clampScalar(e,t){return this.x=Ve(this.x,e,t),this.y=Ve(this.y,e,t),this.z=Ve(this.z,e,t),this.w=Ve(this.w,e,t),this}clampLength(e,t){let n=this.length();return this.divideScalar(n||1).multiplyScalar(Ve(n,e,t))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this.w=Math.floor(this.w),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this.w=Math.ceil(this.w),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this.w=Math.round(this.w),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this.w=Math.trunc(this.w),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this.w=-this.w,this}dot(e){return this.x*e.x+this.y*e.y+this.z*e.z+this.w*e.w}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)+Math.abs(this.w)}normalize(){return this.divideScalar(this.length()||1)}setLength(e){return this.normalize().multiplyScalar(e)}lerp(e,t){return this.x+=(e.x-this.x)*t,this.y+=(e.y-this.y)*t,this.z+=(e.z-this.z)*t,this.w+=(e.w-this.w)*t,this}lerpVectors(e,t,n){return this.x=e.x+(t.x-e.x)*n,this.y=e.y+(t.y-e.y)*n,this.z=e.z+(t.z-e.z)*n,this.w=e.w+(t.w-e.w)*n,this}equals(e){return e.x===this.x&&e.y===this.y&&e.z===this.z&&e.w===this.w}fromArray(e,t=0){return this.x=e[t],this.y=e[t+1],this.z=e[t+2],this.w=e[t+3],this}toArray(e=[],t=0){return e[t]=this.x,e[t+1]=this.y,e[t+2]=this.z,e[t+3]=this.w,e}fromBufferAttribute(e,t){return this.x=e.getX(t),this.y=e.getY(t),this.z=e.getZ(t),this.w=e.getW(t),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this.w=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z,yield this.w}},$a=class extends li{constructor(e=1,t=1,n={}){super(),n=Object.assign({generateMipmaps:!1,internalFormat:null,minFilter:pn,depthBuffer:!0,stencilBuffer:!1,resolveColorBuffer:!0,resolveDepthBuffer:!0,resolveStencilBuffer:!0,storeMultisampledColorBuffer:!0,storeMultisampledDepthBuffer:!0,storeMultisampledStencilBuffer:!0,depthTexture:null,samples:0,count:1,depth:1,multiview:!1,useArrayDepthTexture:!1},n),this.isRenderTarget=!0,this.width=e,this.height=t,this.depth=n.depth,this.scissor=new Ct(0,0,e,t),this.scissorTest=!1,this.viewport=new Ct(0,0,e,t),this.textures=[];let s=n.count;for(let r=0;r<s;r++)this.textures[r]=new mn({width:e,height:t,depth:n.depth}),this.textures[r].isRenderTargetTexture=!0,this.textures[r].renderTarget=this;this._setTextureOptions(n),this.depthBuffer=n.depthBuffer,this.stencilBuffer=n.stencilBuffer,this.resolveColorBuffer=n.resolveColorBuffer,this.resolveDepthBuffer=n.resolveDepthBuffer,this.resolveStencilBuffer=n.resolveStencilBuffer,this.storeMultisampledColorBuffer=n.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=n.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=n.storeMultisampledStencilBuffer,this._depthTexture=null,this.depthTexture=n.depthTexture,this.samples=n.samples,this.multiview=n.multiview,this.useArrayDepthTexture=n.useArrayDepthTexture}_setTextureOptions(e={}){let t={minFilter:pn,generateMipmaps:!1,flipY:!1,internalFormat:null};e.mapping!==void 0&&(t.mapping=e.mapping),e.wrapS!==void 0&&(t.wrapS=e.wrapS),e.wrapT!==void 0&&(t.wrapT=e.wrapT),e.wrapR!==void 0&&(t.wrapR=e.wrapR),e.magFilter!==void 0&&(t.magFilter=e.magFilter),e.minFilter!==void 0&&(t.minFilter=e.minFilter),e.format!==void 0&&(t.format=e.format),e.type!==void 0&&(t.type=e.type),e.anisotropy!==void 0&&(t.anisotropy=e.anisotropy),e.colorSpace!==void 0&&(t.colorSpace=e.colorSpace),e.flipY!==void 0&&(t.flipY=e.flipY),e.generateMipmaps!==void 0&&(t.generateMipmaps=e.generateMipmaps),e.mipmapsAutoUpdate!==void 0&&(t.mipmapsAutoUpdate=e.mipmapsAutoUpdate),e.internalFormat!==void 0&&(t.internalFormat=e.internalFormat);for(let n=0;n<this.textures.length;n++)this.textures[n].setValues(t)}get texture(){return this.textures[0]}set texture(e){this.textures[0]=e}set depthTexture(e){this._depthTexture!==null&&this._depthTexture.renderTarget===this&&(this._depthTexture.renderTarget=null),e!==null&&e.renderTarget===null&&(e.renderTarget=this),this._depthTexture=e}get depthTexture(){return this._depthTexture}setSize(e,t,n=1){if(this.width!==e||this.height!==t||this.depth!==n){this.width=e,this.height=t,this.depth=n;for(let s=0,r=this.textures.length;s<r;s++)this.textures[s].image.width=e,this.textures[s].image.height=t,this.textures[s].image.depth=n,this.textures[s].isData3DTexture!==!0&&(this.textures[s].isArrayTexture=this.textures[s].image.depth>1);this.dispose()}this.viewport.set(0,0,e,t),this.scissor.set(0,0,e,t)}clone(){return new this.constructor().copy(this)}copy(e){this.width=e.width,this.height=e.height,this.depth=e.depth,this.scissor.copy(e.scissor),this.scissorTest=e.scissorTest,this.viewport.copy(e.viewport),this.textures.length=0;for(let t=0,n=e.textures.length;t<n;t++){this.textures[t]=e.textures[t].clone(),this.textures[t].isRenderTargetTexture=!0,this.textures[t].renderTarget=this;let s=Object.assign({},e.textures[t].image);this.textures[t].source=new Xs(s)}if(this.depthBuffer=e.depthBuffer,this.stencilBuffer=e.stencilBuffer,this.resolveColorBuffer=e.resolveColorBuffer,this.resolveDepthBuffer=e.resolveDepthBuffer,this.resolveStencilBuffer=e.resolveStencilBuffer,this.storeMultisampledColorBuffer=e.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=e.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=e.storeMultisampledStencilBuffer,e.depthTexture!==null)if(e.depthTexture.renderTarget===e){let t=e.depthTexture.clone();t.renderTarget=null,this.depthTexture=t}else this.depthTexture=e.depthTexture;else this.depthTexture=null;return this.samples=e.samples,this.multiview=e.multiview,this.useArrayDepthTexture=e.useArrayDepthTexture,this}dispose(){this.dispatchEvent({type:"dispose"})}},gn=class extends $a{constructor(e=1,t=1,n={}){super(e,t,n),this.isWebGLRenderTarget=!0}},eo=class extends mn{constructor(e=null,t=1,n=1,s=1){super(null),this.isDataArrayTexture=!0,this.image={data:e,width:t,height:n,depth:s},this.magFilter=Dt,this.minFilter=Dt,this.wrapR=ai,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1,this.layerUpdates=new Set}copy(e){return super.copy(e),this.wrapR=e.wrapR,this}addLayerUpdate(e){this.layerUpdates.add(e)}clearLayerUpdates(){this.layerUpdates.clear()}};var Ya=class extends mn{constructor(e=null,t=1,n=1,s=1){super(null),this.isData3DTexture=!0,this.image={data:e,width:t,height:n,depth:s},this.magFilter=Dt,this.minFilter=Dt,this.wrapR=ai,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}copy(e){return super.copy(e),this.wrapR=e.wrapR,this}};var Le=class i{static{this.prototype.isMatrix4=!0}constructor(e,t,n,s,r,o,a,l,c,h,u,d,f,p,v,m){this.elements=[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1],e!==void 0&&this.set(e,t,n,s,r,o,a,l,c,h,u,d,f,p,v,m)}set(e,t,n,s,r,o,a,l,c,h,u,d,f,p,v,m){let g=this.elements;return g[0]=e,g[4]=t,g[8]=n,g[12]=s,g[1]=r,g[5]=o,g[9]=a,g[13]=l,g[2]=c,g[6]=h,g[10]=u,g[14]=d,g[3]=f,g[7]=p,g[11]=v,g[15]=m,this}identity(){return this.set(1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1),this}clone(){return new i().fromArray(this.elements)}copy(e){let t=this.elements,n=e.elements;return t[0]=n[0],t[1]=n[1],t[2]=n[2],t[3]=n[3],t[4]=n[4],t[5]=n[5],t[6]=n[6],t[7]=n[7],t[8]=n[8],t[9]=n[9],t[10]=n[10],t[11]=n[11],t[12]=n[12],t[13]=n[13],t[14]=n[14],t[15]=n[15],this}copyPosition(e){let t=this.elements,n=e.elements;return t[12]=n[12],t[13]=n[13],t[14]=n[14],this}setFromMatrix3(e){let t=e.elements;return this.set(t[0],t[3],t[6],0,t[1],t[4],t[7],0,t[2],t[5],t[8],0,0,0,0,1),this}extractBasis(e,t,n){return this.determinantAffine()===0?(e.set(1,0,0),t.set(0,1,0),n.set(0,0,1),this):(e.setFromMatrixColumn(this,0),t.setFromMatrixColumn(this,1),n.setFromMatrixColumn(this,2),this)}makeBasis(e,t,n){return this.set(e.x,t.x,n.x,0,e.y,t.y,n.y,0,e.z,t.z,n.z,0,0,0,0,1),this}extractRotation(e){if(e.determinantAffine()===0)return this.identity();let t=this.elements,n=e.elements,s=1/Ss.setFromMatrixColumn(e,0).length(),r=1/Ss.setFromMatrixColumn(e,1).length(),o=1/Ss.setFromMatrixColumn(e,2).length();return t[0]=n[0]*s,t[1]=n[1]*s,t[2]=n[2]*s,t[3]=0,t[4]=n[4]*r,t[5]=n[5]*r,t[6]=n[6]*r,t[7]=0,t[8]=n[8]*o,t[9]=n[9]*o,t[10]=n[10]*o,t[11]=0,t[12]=0,t[13]=0,t[14]=0,t[15]=1,this}makeRotationFromEuler(e){let t=this.elements,n=e.x,s=e.y,r=e.z,o=Math.cos(n),a=Math.sin(n),l=Math.cos(s),c=Math.sin(s),h=Math.cos(r),u=Math.sin(r);if(e.order==="XYZ"){let d=o*h,f=o*u,p=a*h,v=a*u;t[0]=l*h,t[4]=-l*u,t[8]=c,t[1]=f+p*c,t[5]=d-v*c,t[9]=-a*l,t[2]=v-d*c,t[6]=p+f*c,t[10]=o*l}else if(e.order==="YXZ"){let d=l*h,f=l*u,p=c*h,v=c*u;t[0]=d+v*a,t[4]=p*a-f,t[8]=o*c,t[1]=o*u,t[5]=o*h,t[9]=-a,t[2]=f*a-p,t[6]=v+d*a,t[10]=o*l}else if(e.order==="ZXY"){let d=l*h,f=l*u,p=c*h,v=c*u;t[0]=d-v*a,t[4]=-o*u,t[8]=p+f*a,t[1]=f+p*a,t[5]=o*h,t[9]=v-d*a,t[2]=-o*c,t[6]=a,t[10]=o*l}else if(e.order==="ZYX"){let d=o*h,f=o*u,p=a*h,v=a*u;t[0]=l*h,t[4]=p*c-f,t[8]=d*c+v,t[1]=l*u,t[5]=v*c+d,t[9]=f*c-p,t[2]=-c,t[6]=a*l,t[10]=o*l}else if(e.order==="YZX"){let d=o*l,f=o*c,p=a*l,v=a*c;t[0]=l*h,t[4]=v-d*u,t[8]=p*u+f,t[1]=u,t[5]=o*h,t[9]=-a*h,t[2]=-c*h,t[6]=f*u+p,t[10]=d-v*u}else if(e.order==="XZY"){let d=o*l,f=o*c,p=a*l,v=a*c;t[0]=l*h,t[4]=-u,t[8]=c*h,t[1]=d*u+v,t[5]=o*h,t[9]=f*u-p,t[2]=p*u-f,t[6]=a*h,t[10]=v*u+d}return t[3]=0,t[7]=0,t[11]=0,t[12]=0,t[13]=0,t[14]=0,t[15]=1,this}makeRotationFromQuaternion(e){return this.compose(Vy,e,Gy)}lookAt(e,t,n){let s=this.elements;return An.subVectors(e,t),An.lengthSq()===0&&(An.z=1),An.normalize(),Di.crossVectors(n,An),Di.lengthSq()===0&&(Math.abs(n.z)===1?An.x+=1e-4:An.z+=1e-4,An.normalize(),Di.crossVectors(n,An)),Di.normalize(),na.crossVectors(An,Di),s[0]=Di.x,s[4]=na.x,s[8]=An.x,s[1]=Di.y,s[5]=na.y,s[9]=An.y,s[2]=Di.z,s[6]=na.z,s[10]=An.z,this}multiply(e){return this.multiplyMatrices(this,e)}premultiply(e){return this.multiplyMatrices(e,this)}multiplyMatrices(e,t){let n=e.elements,s=t.elements,r=this.elements,o=n[0],a=n[4],l=n[8],c=n[12],h=n[1],u=n[5],d=n[9],f=n[13],p=n[2],v=n[6],m=n[10],g=n[14],x=n[3],b=n[7],_=n[11],M=n[15],A=s[0],y=s[4],S=s[8],N=s[12],E=s[1],R=s[5],L=s[9],O=s[13],I=s[2],k=s[6],H=s[10],W=s[14],te=s[3],q=s[7],Q=s[11],ee=s[15];return r[0]=o*A+a*E+l*I+c*te,r[4]=o*y+a*R+l*k+c*q,r[8]=o*S+a*L+l*H+c*Q,r[12]=o*N+a*O+l*W+c*ee,r[1]=h*A+u*E+d*I+f*te,r[5]=h*y+u*R+d*k+f*q,r[9]=h*S+u*L+d*H+f*Q,r[13]=h*N+u*O+d*W+f*ee,r[2]=p*A+v*E+m*I+g*te,r[6]=p*y+v*R+m*k+g*q,r[10]=p*S+v*L+m*H+g*Q,r[14]=p*N+v*O+m*W+g*ee,r[3]=x*A+b*E+_*I+M*te,r[7]=x*y+b*R+_*k+M*q,r[11]=x*S+b*L+_*H+M*Q,r[15]=x*N+b*O+_*W+M*ee,this}multiplyScalar(e){let t=this.elements;return t[0]*=e,t[4]*=e,t[8]*=e,t[12]*=e,t[1]*=e,t[5]*=e,t[9]*=e,t[13]*=e,t[2]*=e,t[6]*=e,t[10]*=e,t[14]*=e,t[3]*=e,t[7]*=e,t[11]*=e,t[15]*=e,this}determinant(){let e=this.elements,t=e[0],n=e[4],s=e[8],r=e[12],o=e[1],a=e[5],l=e[9],c=e[13],h=e[2],u=e[6],d=e[10],f=e[14],p=e[3],v=e[7],m=e[11],g=e[15],x=l*f-c*d,b=a*f-c*u,_=a*d-l*u,M=o*f-c*h,A=o*d-l*h,y=o*u-a*h;return t*(v*x-m*b+g*_)-n*(p*x-m*M+g*A)+s*(p*b-v*M+g*y)-r*(p*_-v*A+m*y)}determinantAffine(){let e=this.elements,t=e[0],n=e[4],s=e[8],r=e[1],o=e[5],a=e[9],l=e[2],c=e[6],h=e[10];return t*(o*h-a*c)-n*(r*h-a*l)+s*(r*c-o*l)}transpose(){let e=this.elements,t;return t=e[1],e[1]=e[4],e[4]=t,t=e[2],e[2]=e[8],e[8]=t,t=e[6],e[6]=e[9],e[9]=t,t=e[3],e[3]=e[12],e[12]=t,t=e[7],e[7]=e[13],e[13]=t,t=e[11],e[11]=e[14],e[14]=t,this}setPosition(e,t,n){let s=this.elements;return e.isVector3?(s[12]=e.x,s[13]=e.y,s[14]=e.z):(s[12]=e,s[13]=t,s[14]=n),this}invert(){let e=this.elements,t=e[0],n=e[1],s=e[2],r=e[3],o=e[4],a=e[5],l=e[6],c=e[7],h=e[8],u=e[9],d=e[10],f=e[11],p=e[12],v=e[13],m=e[14],g=e[15],x=t*a-n*o,b=t*l-s*o,_=t*c-r*o,M=n*l-s*a,A=n*c-r*a,y=s*c-r*l,S=h*v-u*p,N=h*m-d*p,E=h*g-f*p,R=u*m-d*v,L=u*g-f*v,O=d*g-f*m,I=x*O-b*L+_*R+M*E-A*N+y*S;if(I===0)return this.set(0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0);let k=1/I;return e[0]=(a*O-l*L+c*R)*k,e[1]=(s*L-n*O-r*R)*k,e[2]=(v*y-m*A+g*M)*k,e[3]=(d*A-u*y-f*M)*k,e[4]=(l*E-o*O-c*N)*k,e[5]=(t*O-s*E+r*N)*k,e[6]=(m*_-p*y-g*b)*k,e[7]=(h*y-d*_+f*b)*k,e[8]=(o*L-a*E+c*S)*k,e[9]=(n*E-t*L-r*S)*k,e[10]=(p*A-v*_+g*x)*k,e[11]=(u*_-h*A-f*x)*k,e[12]=(a*N-o*R-l*S)*k,e[13]=(t*R-n*N+s*S)*k,e[14]=(v*b-p*M-m*x)*k,e[15]=(h*M-u*b+d*x)*k,this}scale(e){let t=this.elements,n=e.x,s=e.y,r=e.z;return t[0]*=n,t[4]*=s,t[8]*=r,t[1]*=n,t[5]*=s,t[9]*=r,t[2]*=n,t[6]*=s,t[10]*=r,t[3]*=n,t[7]*=s,t[11]*=r,this}getMaxScaleOnAxis(){let e=this.elements,t=e[0]*e[0]+e[1]*e[1]+e[2]*e[2],n=e[4]*e[4]+e[5]*e[5]+e[6]*e[6],s=e[8]*e[8]+e[9]*e[9]+e[10]*e[10];return Math.sqrt(Math.max(t,n,s))}makeTranslation(e,t,n){return e.isVector3?this.set(1,0,0,e.x,0,1,0,e.y,0,0,1,e.z,0,0,0,1):this.set(1,0,0,e,0,1,0,t,0,0,1,n,0,0,0,1),this}makeRotationX(e){let t=Math.cos(e),n=Math.sin(e);return this.set(1,0,0,0,0,t,-n,0,0,n,t,0,0,0,0,1),this}makeRotationY(e){let t=Math.cos(e),n=Math.sin(e);return this.set(t,0,n,0,0,1,0,0,-n,0,t,0,0,0,0,1),this}makeRotationZ(e){let t=Math.cos(e),n=Math.sin(e);return this.set(t,-n,0,0,n,t,0,0,0,0,1,0,0,0,0,1),this}makeRotationAxis(e,t){let n=Math.cos(t),s=Math.sin(t),r=1-n,o=e.x,a=e.y,l=e.z,c=r*o,h=r*a;return this.set(c*o+n,c*a-s*l,c*l+s*a,0,c*a+s*l,h*a+n,h*l-s*o,0,c*l-s*a,h*l+s*o,r*l*l+n,0,0,0,0,1),this}makeScale(e,t,n){return this.set(e,0,0,0,0,t,0,0,0,0,n,0,0,0,0,1),this}makeShear(e,t,n,s,r,o){return this.set(1,n,r,0,e,1,o,0,t,s,1,0,0,0,0,1),this}compose(e,t,n){let s=this.elements,r=t._x,o=t._y,a=t._z,l=t._w,c=r+r,h=o+o,u=a+a,d=r*c,f=r*h,p=r*u,v=o*h,m=o*u,g=a*u,x=l*c,b=l*h,_=l*u,M=n.x,A=n.y,y=n.z;return s[0]=(1-(v+g))*M,s[1]=(f+_)*M,s[2]=(p-b)*M,s[3]=0,s[4]=(f-_)*A,s[5]=(1-(d+g))*A,s[6]=(m+x)*A,s[7]=0,s[8]=(p+b)*y,s[9]=(m-x)*y,s[10]=(1-(d+v))*y,s[11]=0,s[12]=e.x,s[13]=e.y,s[14]=e.z,s[15]=1,this}decompose(e,t,n){let s=this.elements;e.x=s[12],e.y=s[13],e.z=s[14];let r=this.determinantAffine();if(r===0)return n.set(1,1,1),t.identity(),this;let o=Ss.set(s[0],s[1],s[2]).length(),a=Ss.set(s[4],s[5],s[6]).length(),l=Ss.set(s[8],s[9],s[10]).length();r<0&&(o=-o),jn.copy(this);let c=1/o,h=1/a,u=1/l;return jn.elements[0]*=c,jn.elements[1]*=c,jn.elements[2]*=c,jn.elements[4]*=h,jn.elements[5]*=h,jn.elements[6]*=h,jn.elements[8]*=u,jn.elements[9]*=u,jn.elements[10]*=u,t.setFromRotationMatrix(jn),n.x=o,n.y=a,n.z=l,this}makePerspective(e,t,n,s,r,o,a=Gn,l=!1){let c=this.elements,h=2*r/(t-e),u=2*r/(n-s),d=(t+e)/(t-e),f=(n+s)/(n-s),p,v;if(l)p=r/(o-r),v=o*r/(o-r);else if(a===Gn)p=-(o+r)/(o-r),v=-2*o*r/(o-r);else if(a===Jr)p=-o/(o-r),v=-o*r/(o-r);else throw new Error("THREE.Matrix4.makePerspective(): Invalid coordinate system: "+a);return c[0]=h,c[4]=0,c[8]=d,c[12]=0,c[1]=0,c[5]=u,c[9]=f,c[13]=0,c[2]=0,c[6]=0,c[10]=p,c[14]=v,c[3]=0,c[7]=0,c[11]=-1,c[15]=0,this}makeOrthographic(e,t,n,s,r,o,a=Gn,l=!1){let c=this.elements,h=2/(t-e),u=2/(n-s),d=-(t+e)/(t-e),f=-(n+s)/(n-s),p,v;if(l)p=1/(o-r),v=o/(o-r);else if(a===Gn)p=-2/(o-r),v=-(o+r)/(o-r);else if(a===Jr)p=-1/(o-r),v=-r/(o-r);else throw new Error("THREE.Matrix4.makeOrthographic(): Invalid coordinate system: "+a);return c[0]=h,c[4]=0,c[8]=0,c[12]=d,c[1]=0,c[5]=u,c[9]=0,c[13]=f,c[2]=0,c[6]=0,c[10]=p,c[14]=v,c[3]=0,c[7]=0,c[11]=0,c[15]=1,this}equals(e){let t=this.elements,n=e.elements;for(let s=0;s<16;s++)if(t[s]!==n[s])return!1;return!0}fromArray(e,t=0){for(let n=0;n<16;n++)this.elements[n]=e[n+t];return this}toArray(e=[],t=0){let n=this.elements;return e[t]=n[0],e[t+1]=n[1],e[t+2]=n[2],e[t+3]=n[3],e[t+4]=n[4],e[t+5]=n[5],e[t+6]=n[6],e[t+7]=n[7],e[t+8]=n[8],e[t+9]=n[9],e[t+10]=n[10],e[t+11]=n[11],e[t+12]=n[12],e[t+13]=n[13],e[t+14]=n[14],e[t+15]=n[15],e}},Ss=new C,jn=new Le,Vy=new C(0,0,0),Gy=new C(1,1,1),Di=new C,na=new C,An=new C,Nf=new Le,Df=new jt,ki=class i{constructor(e=0,t=0,n=0,s=i.DEFAULT_ORDER){this.isEuler=!0,this._x=e,this._y=t,this._z=n,this._order=s}get x(){return this._x}set x(e){this._x=e,this._onChangeCallback()}get y(){return this._y}set y(e){this._y=e,this._onChangeCallback()}get z(){return this._z}set z(e){this._z=e,this._onChangeCallback()}get order(){return this._order}set order(e){this._order=e,this._onChangeCallback()}set(e,t,n,s=this._order){return this._x=e,this._y=t,this._z=n,this._order=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._order)}copy(e){return this._x=e._x,this._y=e._y,this._z=e._z,this._order=e._order,this._onChangeCallback(),this}setFromRotationMatrix(e,t=this._order,n=!0){let s=e.elements,r=s[0],o=s[4],a=s[8],l=s[1],c=s[5],h=s[9],u=s[2],d=s[6],f=s[10];switch(t){case"XYZ":this._y=Math.asin(Ve(a,-1,1)),Math.abs(a)<.9999999?(this._x=Math.atan2(-h,f),this._z=Math.atan2(-o,r)):(this._x=Math.atan2(d,c),this._z=0);break;case"YXZ":this._x=Math.asin(-Ve(h,-1,1)),Math.abs(h)<.9999999?(this._y=Math.atan2(a,f),this._z=Math.atan2(l,c)):(this._y=Math.atan2(-u,r),this._z=0);break;case"ZXY":this._x=Math.asin(Ve(d,-1,1)),Math.abs(d)<.9999999?(this._y=Math.atan2(-u,f),this._z=Math.atan2(-o,c)):(this._y=0,this._z=Math.atan2(l,r));break;case"ZYX":this._y=Math.asin(-Ve(u,-1,1)),Math.abs(u)<.9999999?(this._x=Math.atan2(d,f),this._z=Math.atan2(l,r)):(this._x=0,this._z=Math.atan2(-o,c));break;case"YZX":this._z=Math.asin(Ve(l,-1,1)),Math.abs(l)<.9999999?(this._x=Math.atan2(-h,c),this._y=Math.atan2(-u,r)):(this._x=0,this._y=Math.atan2(a,f));break;case"XZY":this._z=Math.asin(-Ve(o,-1,1)),Math.abs(o)<.9999999?(this._x=Math.atan2(d,c),this._y=Math.atan2(a,r)):(this._x=Math.atan2(-h,f),this._y=0);break;default:Re("Euler: .setFromRotationMatrix() encountered an unknown order: "+t)}return this._order=t,n===!0&&this._onChangeCallback(),this}setFromQuaternion(e,t,n){return Nf.makeRotationFromQuaternion(e),this.setFromRotationMatrix(Nf,t,n)}setFromVector3(e,t=this._order){return this.set(e.x,e.y,e.z,t)}reorder(e){return Df.setFromEuler(this),this.setFromQuaternion(Df,e)}equals(e){return e._x===this._x&&e._y===this._y&&e._z===this._z&&e._order===this._order}fromArray(e){return this._x=e[0],this._y=e[1],this._z=e[2],e[3]!==void 0&&(this._order=e[3]),this._onChangeCallback(),this}toArray(e=[],t=0){return e[t]=this._x,e[t+1]=this._y,e[t+2]=this._z,e[t+3]=this._order,e}_onChange(e){return this._onChangeCallback=e,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._order}};ki.DEFAULT_ORDER="XYZ";var qs=class{constructor(){this.mask=1}set(e){this.mask=(1<<e|0)>>>0}enable(e){this.mask|=1<<e|0}enableAll(){this.mask=-1}toggle(e){this.mask^=1<<e|0}disable(e){this.mask&=~(1<<e|0)}disableAll(){this.mask=0}test(e){return(this.mask&e.mask)!==0}isEnabled(e){return(this.mask&(1<<e|0))!==0}},Hy=0,Of=new C,ws=new jt,xi=new Le,ia=new C,Ur=new C,Wy=new C,Xy=new jt,Uf=new C(1,0,0),Ff=new C(0,1,0),Bf=new C(0,0,1),kf={type:"added"},qy={type:"removed"},Ts={type:"childadded",child:null},kh={type:"childremoved",child:null},yn=class i extends li{constructor(){super(),this.isObject3D=!0,Object.defineProperty(this,"id",{value:Hy++}),this.uuid=qi(),this.name="",this.type="Object3D",this.parent=null,this.children=[],this.up=i.DEFAULT_UP.clone();let e=new C,t=new ki,n=new jt,s=new C(1,1,1);function r(){n.setFromEuler(t,!1)}function o(){t.setFromQuaternion(n,void 0,!1)}t._onChange(r),n._onChange(o),Object.defineProperties(this,{position:{configurable:!0,enumerable:!0,value:e},rotation:{configurable:!0,enumerable:!0,value:t},quaternion:{configurable:!0,enumerable:!0,value:n},scale:{configurable:!0,enumerable:!0,value:s},modelViewMatrix:{value:new Le},normalMatrix:{value:new Ue}}),this.matrix=new Le,this.matrixWorld=new Le,this.matrixAutoUpdate=i.DEFAULT_MATRIX_AUTO_UPDATE,this.matrixWorldAutoUpdate=i.DEFAULT_MATRIX_WORLD_AUTO_UPDATE,this.matrixWorldNeedsUpdate=!1,this.layers=new qs,this.visible=!0,this.castShadow=!1,this.receiveShadow=!1,this.frustumCulled=!0,this.renderOrder=0,this.animations=[],this.customDepthMaterial=void 0,this.customDistanceMaterial=void 0,this.static=!1,this.userData={},this.pivot=null}onBeforeShadow(){}onAfterShadow(){}onBeforeRender(){}onAfterRender(){}applyMatrix4(e){this.matrixAutoUpdate&&this.updateMatrix(),this.matrix.premultiply(e),this.matrix.decompose(this.position,this.quaternion,this.scale),this.pivot!==null&&this.position.copy(this.pivot).applyMatrix4(this.matrix).sub(this.pivot)}applyQuaternion(e){return this.quaternion.premultiply(e),this}setRotationFromAxisAngle(e,t){this.quaternion.setFromAxisAngle(e,t)}setRotationFromEuler(e){this.quaternion.setFromEuler(e,!0)}setRotationFromMatrix(e){this.quaternion.setFromRotationMatrix(e)}setRotationFromQuaternion(e){this.quaternion.copy(e)}rotateOnAxis(e,t){return ws.setFromAxisAngle(e,t),this.quaternion.multiply(ws),this}rotateOnWorldAxis(e,t){return ws.setFromAxisAngle(e,t),this.quaternion.premultiply(ws),this}rotateX(e){return this.rotateOnAxis(Uf,e)}rotateY(e){return this.rotateOnAxis(Ff,e)}rotateZ(e){return this.rotateOnAxis(Bf,e)}translateOnAxis(e,t){return Of.copy(e).applyQuaternion(this.quaternion),this.position.add(Of.multiplyScalar(t)),this}translateX(e){return this.translateOnAxis(Uf,e)}translateY(e){return this.translateOnAxis(Ff,e)}translateZ(e){return this.translateOnAxis(Bf,e)}localToWorld(e){return this.updateWorldMatrix(!0,!1),e.applyMatrix4(this.matrixWorld)}worldToLocal(e){return this.updateWorldMatrix(!0,!1),e.applyMatrix4(xi.copy(this.matrixWorld).invert())}lookAt(e,t,n){e.isVector3?ia.copy(e):ia.set(e,t,n);let s=this.parent;this.updateWorldMatrix(!0,!1),Ur.setFromMatrixPosition(this.matrixWorld),this.isCamera||this.isLight?xi.lookAt(Ur,ia,this.up):xi.lookAt(ia,Ur,this.up),this.quaternion.setFromRotationMatrix(xi),s&&(xi.extractRotation(s.matrixWorld),ws.setFromRotationMatrix(xi),this.quaternion.premultiply(ws.invert()))}add(e){if(arguments.length>1){for(let t=0;t<arguments.length;t++)this.add(arguments[t]);return this}return e===this?(Ne("Object3D.add: object can't be added as a child of itself.",e),this):(e&&e.isObject3D?(e.removeFromParent(),e.parent=this,this.children.push(e),e.dispatchEvent(kf),Ts.child=e,this.dispatchEvent(Ts),Ts.child=null):Ne("Object3D.add: object not an instance of THREE.Object3D.",e),this)}remove(e){if(arguments.length>1){for(let n=0;n<arguments.length;n++)this.remove(arguments[n]);return this}let t=this.children.indexOf(e);return t!==-1&&(e.parent=null,this.children.splice(t,1),e.dispatchEvent(qy),kh.child=e,this.dispatchEvent(kh),kh.child=null),this}removeFromParent(){let e=this.parent;return e!==null&&e.remove(this),this}clear(){return this.remove(...this.children)}attach(e){return this.updateWorldMatrix(!0,!1),xi.copy(this.matrixWorld).invert(),e.parent!==null&&(e.parent.updateWorldMatrix(!0,!1),xi.multiply(e.parent.matrixWorld)),e.applyMatrix4(xi),e.removeFromParent(),e.parent=this,this.children.push(e),e.updateWorldMatrix(!1,!0),e.dispatchEvent(kf),Ts.child=e,this.dispatchEvent(Ts),Ts.child=null,this}getObjectById(e){return this.getObjectByProperty("id",e)}getObjectByName(e){return this.getObjectByProperty("name",e)}getObjectByProperty(e,t){if(this[e]===t)return this;for(let n=0,s=this.children.length;n<s;n++){let o=this.children[n].getObjectByProperty(e,t);if(o!==void 0)return o}}getObjectsByProperty(e,t,n=[]){this[e]===t&&n.push(this);let s=this.children;for(let r=0,o=s.length;r<o;r++)s[r].getObjectsByProperty(e,t,n);return n}getWorldPosition(e){return this.updateWorldMatrix(!0,!1),e.setFromMatrixPosition(this.matrixWorld)}getWorldQuaternion(e){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(Ur,e,Wy),e}getWorldScale(e){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(Ur,Xy,e),e}getWorldDirection(e){this.updateWorldMatrix(!0,!1);let t=this.matrixWorld.elements;return e.set(t[8],t[9],t[10]).normalize()}raycast(){}intersectsFrustum(){return!0}traverse(e){e(this);let t=this.children;for(let n=0,s=t.length;n<s;n++)t[n].traverse(e)}traverseVisible(e){if(this.visible===!1)return;e(this);let t=this.children;for(let n=0,s=t.length;n<s;n++)t[n].traverseVisible(e)}traverseAncestors(e){let t=this.parent;t!==null&&(e(t),t.traverseAncestors(e))}updateMatrix(){this.matrix.compose(this.position,this.quaternion,this.scale);let e=this.pivot;if(e!==null){let t=e.x,n=e.y,s=e.z,r=this.matrix.elements;r[12]+=t-r[0]*t-r[4]*n-r[8]*s,r[13]+=n-r[1]*t-r[5]*n-r[9]*s,r[14]+=s-r[2]*t-r[6]*n-r[10]*s}this.matrixWorldNeedsUpdate=!0}updateMatrixWorld(e){this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||e)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,e=!0);let t=this.children;for(let n=0,s=t.length;n<s;n++)t[n].updateMatrixWorld(e)}updateWorldMatrix(e,t,n=!1){let s=this.parent;if(e===!0&&s!==null&&s.updateWorldMatrix(!0,!1),this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||n)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,n=!0),t===!0){let r=this.children;for(let o=0,a=r.length;o<a;o++)r[o].updateWorldMatrix(!1,!0,n)}}toJSON(e){let t=e===void 0||typeof e=="string",n={};t&&(e={geometries:{},materials:{},textures:{},images:{},shapes:{},skeletons:{},animations:{},nodes:{}},n.metadata={version:4.7,type:"Object",generator:"Object3D.toJSON"});let s={};s.uuid=this.uuid,s.type=this.type,s.name=this.name,s.castShadow=this.castShadow,s.receiveShadow=this.receiveShadow,s.visible=this.visible,s.frustumCulled=this.frustumCulled,s.renderOrder=this.renderOrder,s.static=this.static,s.matrixAutoUpdate=this.matrixAutoUpdate,Object.keys(this.userData).length>0&&(s.userData=this.userData),s.layers=this.layers.mask,s.matrix=this.matrix.toArray(),s.up=this.up.toArray(),this.pivot!==null&&(s.pivot=this.pivot.toArray()),this.morphTargetDictionary!==void 0&&(s.morphTargetDictionary=Object.assign({},this.morphTargetDictionary)),this.morphTargetInfluences!==void 0&&(s.morphTargetInfluences=this.morphTargetInfluences.slice()),this.isInstancedMesh&&(s.type="InstancedMesh",s.count=this.count,s.instanceMatrix=this.instanceMatrix.toJSON(),this.instanceColor!==null&&(s.instanceColor=this.instanceColor.toJSON())),this.isBatchedMesh&&(s.type="BatchedMesh",s.perObjectFrustumCulled=this.perObjectFrustumCulled,s.sortObjects=this.sortObjects,s.drawRanges=this._drawRanges,s.reservedRanges=this._reservedRanges,s.geometryInfo=this._geometryInfo.map(a=>({...a,boundingBox:a.boundingBox?a.boundingBox.toJSON():void 0,boundingSphere:a.boundingSphere?a.boundingSphere.toJSON():void 0})),s.instanceInfo=this._instanceInfo.map(a=>({...a})),s.availableInstanceIds=this._availableInstanceIds.slice(),s.availableGeometryIds=this._availableGeometryIds.slice(),s.nextIndexStart=this._nextIndexStart,s.nextVertexStart=this._nextVertexStart,s.geometryCount=this._geometryCount,s.maxInstanceCount=this._maxInstanceCount,s.maxVertexCount=this._maxVertexCount,s.maxIndexCount=this._maxIndexCount,s.geometryInitialized=this._geometryInitialized,s.matricesTexture=this._matricesTexture.toJSON(e),s.indirectTexture=this._indirectTexture.toJSON(e),this._colorsTexture!==null&&(s.colorsTexture=this._colorsTexture.toJSON(e)),this.boundingSphere!==null&&(s.boundingSphere=this.boundingSphere.toJSON()),this.boundingBox!==null&&(s.boundingBox=this.boundingBox.toJSON()));function r(a,l){return a[l.uuid]===void 0&&(a[l.uuid]=l.toJSON(e)),l.uuid}if(this.isScene)this.background&&(this.background.isColor?s.background=this.background.toJSON():this.background.isTexture&&(s.background=this.background.toJSON(e).uuid)),this.environment&&this.environment.isTexture&&this.environment.isRenderTargetTexture!==!0&&(s.environment=this.environment.toJSON(e).uuid);else if(this.isMesh||this.isLine||this.isPoints){s.geometry=r(e.geometries,this.geometry);let a=this.geometry.parameters;if(a!==void 0&&a.shapes!==void 0){let l=a.shapes;if(Array.isArray(l))for(let c=0,h=l.length;c<h;c++){let u=l[c];r(e.shapes,u)}else r(e.shapes,l)}}if(this.isSkinnedMesh&&(s.bindMode=this.bindMode,s.bindMatrix=this.bindMatrix.toArray(),this.skeleton!==void 0&&(r(e.skeletons,this.skeleton),s.skeleton=this.skeleton.uuid)),this.material!==void 0)if(Array.isArray(this.material)){let a=[];for(let l=0,c=this.material.length;l<c;l++)a.push(r(e.materials,this.material[l]));s.material=a}else s.material=r(e.materials,this.material);if(this.children.length>0){s.children=[];for(let a=0;a<this.children.length;a++)s.children.push(this.children[a].toJSON(e).object)}if(this.animations.length>0){s.animations=[];for(let a=0;a<this.animations.length;a++){let l=this.animations[a];s.animations.push(r(e.animations,l))}}if(t){let a=o(e.geometries),l=o(e.materials),c=o(e.textures),h=o(e.images),u=o(e.shapes),d=o(e.skeletons),f=o(e.animations),p=o(e.nodes);a.length>0&&(n.geometries=a),l.length>0&&(n.materials=l),c.length>0&&(n.textures=c),h.length>0&&(n.images=h),u.length>0&&(n.shapes=u),d.length>0&&(n.skeletons=d),f.length>0&&(n.animations=f),p.length>0&&(n.nodes=p)}return n.object=s,n;function o(a){let l=[];for(let c in a){let h=a[c];delete h.metadata,l.push(h)}return l}}clone(e){return new this.constructor().copy(this,e)}copy(e,t=!0){if(this.name=e.name,this.up.copy(e.up),this.position.copy(e.position),this.rotation.order=e.rotation.order,this.quaternion.copy(e.quaternion),this.scale.copy(e.scale),this.pivot=e.pivot!==null?e.pivot.clone():null,this.matrix.copy(e.matrix),this.matrixWorld.copy(e.matrixWorld),this.matrixAutoUpdate=e.matrixAutoUpdate,this.matrixWorldAutoUpdate=e.matrixWorldAutoUpdate,this.matrixWorldNeedsUpdate=e.matrixWorldNeedsUpdate,this.layers.mask=e.layers.mask,this.visible=e.visible,this.castShadow=e.castShadow,this.receiveShadow=e.receiveShadow,this.frustumCulled=e.frustumCulled,this.renderOrder=e.renderOrder,this.static=e.static,this.animations=e.animations.slice(),this.userData=JSON.parse(JSON.stringify(e.userData)),t===!0)for(let n=0;n<e.children.length;n++){let s=e.children[n];this.add(s.clone())}return this}dispose(){this.dispatchEvent({type:"dispose"})}};yn.DEFAULT_UP=new C(0,1,0);yn.DEFAULT_MATRIX_AUTO_UPDATE=!0;yn.DEFAULT_MATRIX_WORLD_AUTO_UPDATE=!0;var rn=class extends yn{constructor(){super(),this.isGroup=!0,this.type="Group"}},$y={type:"move"},$s=class{constructor(){this._targetRay=null,this._grip=null,this._hand=null}getHandSpace(){return this._hand===null&&(this._hand=new rn,this._hand.matrixAutoUpdate=!1,this._hand.visible=!1,this._hand.joints={},this._hand.inputState={pinching:!1}),this._hand}getTargetRaySpace(){return this._targetRay===null&&(this._targetRay=new rn,this._targetRay.matrixAutoUpdate=!1,this._targetRay.visible=!1,this._targetRay.hasLinearVelocity=!1,this._targetRay.linearVelocity=new C,this._targetRay.hasAngularVelocity=!1,this._targetRay.angularVelocity=new C),this._targetRay}getGripSpace(){return this._grip===null&&(this._grip=new rn,this._grip.matrixAutoUpdate=!1,this._grip.visible=!1,this._grip.hasLinearVelocity=!1,this._grip.linearVelocity=new C,this._grip.hasAngularVelocity=!1,this._grip.angularVelocity=new C,this._grip.eventsEnabled=!1),this._grip}dispatchEvent(e){return this._targetRay!==null&&this._targetRay.dispatchEvent(e),this._grip!==null&&this._grip.dispatchEvent(e),this._hand!==null&&this._hand.dispatchEvent(e),this}connect(e){if(e&&e.hand){let t=this._hand;if(t)for(let n of e.hand.values())this._getHandJoint(t,n)}return this.dispatchEvent({type:"connected",data:e}),this}disconnect(e){return this.dispatchEvent({type:"disconnected",data:e}),this._targetRay!==null&&(this._targetRay.visible=!1),this._grip!==null&&(this._grip.visible=!1),this._hand!==null&&(this._hand.visible=!1),this}update(e,t,n){let s=null,r=null,o=null,a=this._targetRay,l=this._grip,c=this._hand;if(e&&t.session.visibilityState!=="visible-blurred"){if(c&&e.hand){o=!0;for(let v of e.hand.values()){let m=t.getJointPose(v,n),g=this._getHandJoint(c,v);m!==null&&(g.matrix.fromArray(m.transform.matrix),g.matrix.decompose(g.position,g.quaternion,g.scale),g.matrixWorldNeedsUpdate=!0,g.jointRadius=m.radius),g.visible=m!==null}let h=c.joints["index-finger-tip"],u=c.joints["thumb-tip"],d=h.position.distanceTo(u.position),f=.02,p=.005;c.inputState.pinching&&d>f+p?(c.inputState.pinching=!1,this.dispatchEvent({type:"pinchend",handedness:e.handedness,target:this})):!c.inputState.pinching&&d<=f-p&&(c.inputState.pinching=!0,this.dispatchEvent({type:"pinchstart",handedness:e.handedness,target:this}))}else l!==null&&e.gripSpace&&(r=t.getPose(e.gripSpace,n),r!==null&&(l.matrix.fromArray(r.transform.matrix),l.matrix.decompose(l.position,l.quaternion,l.scale),l.matrixWorldNeedsUpdate=!0,r.linearVelocity?(l.hasLinearVelocity=!0,l.linearVelocity.copy(r.linearVelocity)):l.hasLinearVelocity=!1,r.angularVelocity?(l.hasAngularVelocity=!0,l.angularVelocity.copy(r.angularVelocity)):l.hasAngularVelocity=!1,l.eventsEnabled&&l.dispatchEvent({type:"gripUpdated",data:e,target:this})));a!==null&&(s=t.getPose(e.targetRaySpace,n),s===null&&r!==null&&(s=r),s!==null&&(a.matrix.fromArray(s.transform.matrix),a.matrix.decompose(a.position,a.quaternion,a.scale),a.matrixWorldNeedsUpdate=!0,s.linearVelocity?(a.hasLinearVelocity=!0,a.linearVelocity.copy(s.linearVelocity)):a.hasLinearVelocity=!1,s.angularVelocity?(a.hasAngularVelocity=!0,a.angularVelocity.copy(s.angularVelocity)):a.hasAngularVelocity=!1,this.dispatchEvent($y)))}return a!==null&&(a.visible=s!==null),l!==null&&(l.visible=r!==null),c!==null&&(c.visible=o!==null),this}_getHandJoint(e,t){if(e.joints[t.jointName]===void 0){let n=new rn;n.matrixAutoUpdate=!1,n.visible=!1,e.joints[t.jointName]=n,e.add(n)}return e.joints[t.jointName]}},jp={aliceblue:15792383,antiquewhite:16444375,aqua:65535,aquamarine:8388564,azure:15794175,beige:16119260,bisque:16770244,black:0,blanchedalmond:16772045,blue:255,blueviolet:9055202,brown:10824234,burlywood:14596231,cadetblue:6266528,chartreuse:8388352,chocolate:13789470,coral:16744272,cornflowerblue:6591981,cornsilk:16775388,crimson:14423100,cyan:65535,darkblue:139,darkcyan:35723,darkgoldenrod:12092939,darkgray:11119017,darkgreen:25600,darkgrey:11119017,darkkhaki:12433259,darkmagenta:9109643,darkolivegreen:5597999,darkorange:16747520,darkorchid:10040012,darkred:9109504,darksalmon:15308410,darkseagreen:9419919,darkslateblue:4734347,darkslategray:3100495,darkslategrey:3100495,darkturquoise:52945,darkviolet:9699539,deeppink:16716947,deepskyblue:49151,dimgray:6908265,dimgrey:6908265,dodgerblue:2003199,firebrick:11674146,floralwhite:16775920,forestgreen:2263842,fuchsia:16711935,gainsboro:14474460,ghostwhite:16316671,gold:16766720,goldenrod:14329120,gray:8421504,green:32768,greenyellow:11403055,grey:8421504,honeydew:15794160,hotpink:16738740,indianred:13458524,indigo:4915330,ivory:16777200,khaki:15787660,lavender:15132410,lavenderblush:16773365,lawngreen:8190976,lemonchiffon:16775885,lightblue:11393254,lightcoral:15761536,lightcyan:14745599,lightgoldenrodyellow:16448210,lightgray:13882323,lightgreen:9498256,lightgrey:13882323,lightpink:16758465,lightsalmon:16752762,lightseagreen:2142890,lightskyblue:8900346,lightslategray:7833753,lightslategrey:7833753,lightsteelblue:11584734,lightyellow:16777184,lime:65280,limegreen:3329330,linen:16445670,magenta:16711935,maroon:8388608,mediumaquamarine:6737322,mediumblue:205,mediumorchid:12211667,mediumpurple:9662683,mediumseagreen:3978097,mediumslateblue:8087790,mediumspringgreen:64154,mediumturquoise:4772300,mediumvioletred:13047173,midnightblue:1644912,mintcream:16121850,mistyrose:16770273,moccasin:16770229,navajowhite:16768685,navy:128,oldlace:16643558,olive:8421376,olivedrab:7048739,orange:16753920,orangered:16729344,orchid:14315734,palegoldenrod:15657130,palegreen:10025880,paleturquoise:11529966,palevioletred:14381203,papayawhip:16773077,peachpuff:16767673,peru:13468991,pink:16761035,plum:14524637,powderblue:11591910,purple:8388736,rebeccapurple:6697881,red:16711680,rosybrown:12357519,royalblue:4286945,saddlebrown:9127187,salmon:16416882,sandybrown:16032864,seagreen:3050327,seashell:16774638,sienna:10506797,silver:12632256,skyblue:8900331,slateblue:6970061,slategray:7372944,slategrey:7372944,snow:16775930,springgreen:65407,steelblue:4620980,tan:13808780,teal:32896,thistle:14204888,tomato:16737095,turquoise:4251856,violet:15631086,wheat:16113331,white:16777215,whitesmoke:16119285,yellow:16776960,yellowgreen:10145074},Oi={h:0,s:0,l:0},sa={h:0,s:0,l:0};function zh(i,e,t){return t<0&&(t+=1),t>1&&(t-=1),t<1/6?i+(e-i)*6*t:t<1/2?e:t<2/3?i+(e-i)*6*(2/3-t):i}var De=class{constructor(e,t,n){return this.isColor=!0,this.r=1,this.g=1,this.b=1,this.set(e,t,n)}set(e,t,n){if(t===void 0&&n===void 0){let s=e;s&&s.isColor?this.copy(s):typeof s=="number"?this.setHex(s):typeof s=="string"&&this.setStyle(s)}else this.setRGB(e,t,n);return this}setScalar(e){return this.r=e,this.g=e,this.b=e,this}setHex(e,t=dn){return e=Math.floor(e),this.r=(e>>16&255)/255,this.g=(e>>8&255)/255,this.b=(e&255)/255,$e.colorSpaceToWorking(this,t),this}setRGB(e,t,n,s=$e.workingColorSpace){return this.r=e,this.g=t,this.b=n,$e.colorSpaceToWorking(this,s),this}setHSL(e,t,n,s=$e.workingColorSpace){if(e=qu(e,1),t=Ve(t,0,1),n=Ve(n,0,1),t===0)this.r=this.g=this.b=n;else{let r=n<=.5?n*(1+t):n+t-n*t,o=2*n-r;this.r=zh(o,r,e+1/3),this.g=zh(o,r,e),this.b=zh(o,r,e-1/3)}return $e.colorSpaceToWorking(this,s),this}setStyle(e,t=dn){function n(r){r!==void 0&&parseFloat(r)<1&&Re("Color: Alpha component of "+e+" will be ignored.")}let s;if(s=/^(\w+)\(([^\)]*)\)/.exec(e)){let r,o=s[1],a=s[2];switch(o){case"rgb":case"rgba":if(r=/^\s*(\d+)\s*,\s*(\d+)\s*,\s*(\d+)\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return n(r[4]),this.setRGB(Math.min(255,parseInt(r[1],10))/255,Math.min(255,parseInt(r[2],10))/255,Math.min(255,parseInt(r[3],10))/255,t);if(r=/^\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return n(r[4]),this.setRGB(Math.min(100,parseFloat(r[1]))/100,Math.min(100,parseFloat(r[2]))/100,Math.min(100,parseFloat(r[3]))/100,t);break;case"hsl":case"hsla":if(r=/^\s*([+-]?(?:\d+(?:\.\d+)?|\.\d+))\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return n(r[4]),this.setHSL(parseFloat(r[1])/360,parseFloat(r[2])/100,parseFloat(r[3])/100,t);break;default:Re("Color: Unknown color model "+e)}}else if(s=/^\#([A-Fa-f\d]+)$/.exec(e)){let r=s[1],o=r.length;if(o===3)return this.setRGB(parseInt(r.charAt(0),16)/15,parseInt(r.charAt(1),16)/15,parseInt(r.charAt(2),16)/15,t);if(o===6)return this.setHex(parseInt(r,16),t);Re("Color: Invalid hex color "+e)}else if(e&&e.length>0)return this.setColorName(e,t);return this}setColorName(e,t=dn){let n=jp[e.toLowerCase()];return n!==void 0?this.setHex(n,t):Re("Color: Unknown color "+e),this}clone(){return new this.constructor(this.r,this.g,this.b)}copy(e){return this.r=e.r,this.g=e.g,this.b=e.b,this}copySRGBToLinear(e){return this.r=Si(e.r),this.g=Si(e.g),this.b=Si(e.b),this}copyLinearToSRGB(e){return this.r=Vs(e.r),this.g=Vs(e.g),this.b=Vs(e.b),this}convertSRGBToLinear(){return this.copySRGBToLinear(this),this}convertLinearToSRGB(){return this.copyLinearToSRGB(this),this}getHex(e=dn){return $e.workingToColorSpace(nn.copy(this),e),Math.round(Ve(nn.r*255,0,255))*65536+Math.round(Ve(nn.g*255,0,255))*256+Math.round(Ve(nn.b*255,0,255))}getHexString(e=dn){return("000000"+this.getHex(e).toString(16)).slice(-6)}getHSL(e,t=$e.workingColorSpace){$e.workingToColorSpace(nn.copy(this),t);let n=nn.r,s=nn.g,r=nn.b,o=Math.max(n,s,r),a=Math.min(n,s,r),l,c,h=(a+o)/2;if(a===o)l=0,c=0;else{let u=o-a;switch(c=h<=.5?u/(o+a):u/(2-o-a),o){case n:l=(s-r)/u+(s<r?6:0);break;case s:l=(r-n)/u+2;break;case r:l=(n-s)/u+4;break}l/=6}return e.h=l,e.s=c,e.l=h,e}getRGB(e,t=$e.workingColorSpace){return $e.workingToColorSpace(nn.copy(this),t),e.r=nn.r,e.g=nn.g,e.b=nn.b,e}getStyle(e=dn){$e.workingToColorSpace(nn.copy(this),e);let t=nn.r,n=nn.g,s=nn.b;return e!==dn?`color(${e} ${t.toFixed(3)} ${n.toFixed(3)} ${s.toFixed(3)})`:`rgb(${Math.round(t*255)},${Math.round(n*255)},${Math.round(s*255)})`}offsetHSL(e,t,n){return this.getHSL(Oi),this.setHSL(Oi.h+e,Oi.s+t,Oi.l+n)}add(e){return this.r+=e.r,this.g+=e.g,this.b+=e.b,this}addColors(e,t){return this.r=e.r+t.r,this.g=e.g+t.g,this.b=e.b+t.b,this}addScalar(e){return this.r+=e,this.g+=e,this.b+=e,this}sub(e){return this.r=Math.max(0,this.r-e.r),this.g=Math.max(0,this.g-e.g),this.b=Math.max(0,this.b-e.b),this}multiply(e){return this.r*=e.r,this.g*=e.g,this.b*=e.b,this}multiplyScalar(e){return this.r*=e,this.g*=e,this.b*=e,this}lerp(e,t){return this.r+=(e.r-this.r)*t,this.g+=(e.g-this.g)*t,this.b+=(e.b-this.b)*t,this}lerpColors(e,t,n){return this.r=e.r+(t.r-e.r)*n,this.g=e.g+(t.g-e.g)*n,this.b=e.b+(t.b-e.b)*n,this}lerpHSL(e,t){this.getHSL(Oi),e.getHSL(sa);let n=$r(Oi.h,sa.h,t),s=$r(Oi.s,sa.s,t),r=$r(Oi.l,sa.l,t);return this.setHSL(n,s,r),this}setFromVector3(e){return this.r=e.x,this.g=e.y,this.b=e.z,this}applyMatrix3(e){let t=this.r,n=this.g,s=this.b,r=e.elements;return this.r=r[0]*t+r[3]*n+r[6]*s,this.g=r[1]*t+r[4]*n+r[7]*s,this.b=r[2]*t+r[5]*n+r[8]*s,this}equals(e){return e.r===this.r&&e.g===this.g&&e.b===this.b}fromArray(e,t=0){return this.r=e[t],this.g=e[t+1],this.b=e[t+2],this}toArray(e=[],t=0){return e[t]=this.r,e[t+1]=this.g,e[t+2]=this.b,e}fromBufferAttribute(e,t){return this.r=e.getX(t),this.g=e.getY(t),this.b=e.getZ(t),this}toJSON(){return this.getHex()}*[Symbol.iterator](){yield this.r,yield this.g,yield this.b}},nn=new De;De.NAMES=jp;var zi=class extends yn{constructor(){super(),this.isScene=!0,this.type="Scene",this.background=null,this.environment=null,this.fog=null,this.backgroundBlurriness=0,this.backgroundIntensity=1,this.backgroundRotation=new ki,this.environmentIntensity=1,this.environmentRotation=new ki,this.overrideMaterial=null,typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}copy(e,t){return super.copy(e,t),this.background=e.background!==null?e.background.clone():null,this.environment=e.environment!==null?e.environment.clone():null,this.fog=e.fog!==null?e.fog.clone():null,this.backgroundBlurriness=e.backgroundBlurriness,this.backgroundIntensity=e.backgroundIntensity,this.backgroundRotation.copy(e.backgroundRotation),this.environmentIntensity=e.environmentIntensity,this.environmentRotation.copy(e.environmentRotation),this.overrideMaterial=e.overrideMaterial!==null?e.overrideMaterial.clone():null,this.matrixAutoUpdate=e.matrixAutoUpdate,this}toJSON(e){let t=super.toJSON(e);return this.fog!==null&&(t.object.fog=this.fog.toJSON()),t.object.backgroundBlurriness=this.backgroundBlurriness,t.object.backgroundIntensity=this.backgroundIntensity,t.object.backgroundRotation=this.backgroundRotation.toArray(),t.object.environmentIntensity=this.environmentIntensity,t.object.environmentRotation=this.environmentRotation.toArray(),t}},Zn=new C,_i=new C,Vh=new C,vi=new C,As=new C,Es=new C,zf=new C,Gh=new C,Hh=new C,Wh=new C,Xh=new Ct,qh=new Ct,$h=new Ct,Yt=class i{constructor(e=new C,t=new C,n=new C){this.a=e,this.b=t,this.c=n}static getNormal(e,t,n,s){s.subVectors(n,t),Zn.subVectors(e,t),s.cross(Zn);let r=s.lengthSq();return r>0?s.multiplyScalar(1/Math.sqrt(r)):s.set(0,0,0)}static getBarycoord(e,t,n,s,r){Zn.subVectors(s,t),_i.subVectors(n,t),Vh.subVectors(e,t);let o=Zn.dot(Zn),a=Zn.dot(_i),l=Zn.dot(Vh),c=_i.dot(_i),h=_i.dot(Vh),u=o*c-a*a;if(u===0)return r.set(0,0,0),null;let d=1/u,f=(c*l-a*h)*d,p=(o*h-a*l)*d;return r.set(1-f-p,p,f)}static containsPoint(e,t,n,s){return this.getBarycoord(e,t,n,s,vi)===null?!1:vi.x>=0&&vi.y>=0&&vi.x+vi.y<=1}static getInterpolation(e,t,n,s,r,o,a,l){return this.getBarycoord(e,t,n,s,vi)===null?(l.x=0,l.y=0,"z"in l&&(l.z=0),"w"in l&&(l.w=0),null):(l.setScalar(0),l.addScaledVector(r,vi.x),l.addScaledVector(o,vi.y),l.addScaledVector(a,vi.z),l)}static getInterpolatedAttribute(e,t,n,s,r,o){return Xh.setScalar(0),qh.setScalar(0),$h.setScalar(0),Xh.fromBufferAttribute(e,t),qh.fromBufferAttribute(e,n),$h.fromBufferAttribute(e,s),o.setScalar(0),o.addScaledVector(Xh,r.x),o.addScaledVector(qh,r.y),o.addScaledVector($h,r.z),o}static isFrontFacing(e,t,n,s){return Zn.subVectors(n,t),_i.subVectors(e,t),Zn.cross(_i).dot(s)<0}set(e,t,n){return this.a.copy(e),this.b.copy(t),this.c.copy(n),this}setFromPointsAndIndices(e,t,n,s){return this.a.copy(e[t]),this.b.copy(e[n]),this.c.copy(e[s]),this}setFromAttributeAndIndices(e,t,n,s){return this.a.fromBufferAttribute(e,t),this.b.fromBufferAttribute(e,n),this.c.fromBufferAttribute(e,s),this}clone(){return new this.constructor().copy(this)}copy(e){return this.a.copy(e.a),this.b.copy(e.b),this.c.copy(e.c),this}getArea(){return Zn.subVectors(this.c,this.b),_i.subVectors(this.a,this.b),Zn.cross(_i).length()*.5}getMidpoint(e){return e.addVectors(this.a,this.b).add(this.c).multiplyScalar(1/3)}getNormal(e){return i.getNormal(this.a,this.b,this.c,e)}getPlane(e){return e.setFromCoplanarPoints(this.a,this.b,this.c)}getBarycoord(e,t){return i.getBarycoord(e,this.a,this.b,this.c,t)}getInterpolation(e,t,n,s,r){return i.getInterpolation(e,this.a,this.b,this.c,t,n,s,r)}containsPoint(e){return i.containsPoint(e,this.a,this.b,this.c)}isFrontFacing(e){return i.isFrontFacing(this.a,this.b,this.c,e)}intersectsBox(e){return e.intersectsTriangle(this)}closestPointToPoint(e,t){let n=this.a,s=this.b,r=this.c,o,a;As.subVectors(s,n),Es.subVectors(r,n),Gh.subVectors(e,n);let l=As.dot(Gh),c=Es.dot(Gh);if(l<=0&&c<=0)return t.copy(n);Hh.subVectors(e,s);let h=As.dot(Hh),u=Es.dot(Hh);if(h>=0&&u<=h)return t.copy(s);let d=l*u-h*c;if(d<=0&&l>=0&&h<=0&&l-h>0)return o=l/(l-h),t.copy(n).addScaledVector(As,o);Wh.subVectors(e,r);let f=As.dot(Wh),p=Es.dot(Wh);if(p>=0&&f<=p)return t.copy(r);let v=f*c-l*p;if(v<=0&&c>=0&&p<=0)return a=c/(c-p),t.copy(n).addScaledVector(Es,a);let m=h*p-f*u;if(m<=0&&u-h>=0&&f-p>=0)return zf.subVectors(r,s),a=(u-h)/(u-h+(f-p)),t.copy(s).addScaledVector(zf,a);let g=1/(m+v+d);return o=v*g,a=d*g,t.copy(n).addScaledVector(As,o).addScaledVector(Es,a)}equals(e){return e.a.equals(this.a)&&e.b.equals(this.b)&&e.c.equals(this.c)}},st=class{constructor(e=new C(1/0,1/0,1/0),t=new C(-1/0,-1/0,-1/0)){this.isBox3=!0,this.min=e,this.max=t}set(e,t){return this.min.copy(e),this.max.copy(t),this}setFromArray(e){this.makeEmpty();for(let t=0,n=e.length;t<n;t+=3)this.expandByPoint(Jn.fromArray(e,t));return this}setFromBufferAttribute(e){this.makeEmpty();for(let t=0,n=e.count;t<n;t++)this.expandByPoint(Jn.fromBufferAttribute(e,t));return this}setFromPoints(e){this.makeEmpty();for(let t=0,n=e.length;t<n;t++)this.expandByPoint(e[t]);return this}setFromCenterAndSize(e,t){let n=Jn.copy(t).multiplyScalar(.5);return this.min.copy(e).sub(n),this.max.copy(e).add(n),this}setFromObject(e,t=!1){return this.makeEmpty(),this.expandByObject(e,t)}clone(){return new this.constructor().copy(this)}copy(e){return this.min.copy(e.min),this.max.copy(e.max),this}makeEmpty(){return this.min.x=this.min.y=this.min.z=1/0,this.max.x=this.max.y=this.max.z=-1/0,this}isEmpty(){return this.max.x<this.min.x||this.max.y<this.min.y||this.max.z<this.min.z}getCenter(e){return this.isEmpty()?e.set(0,0,0):e.addVectors(this.min,this.max).multiplyScalar(.5)}getSize(e){return this.isEmpty()?e.set(0,0,0):e.subVectors(this.max,this.min)}expandByPoint(e){return this.min.min(e),this.max.max(e),this}expandByVector(e){return this.min.sub(e),this.max.add(e),this}expandByScalar(e){return this.min.addScalar(-e),this.max.addScalar(e),this}expandByObject(e,t=!1){e.updateWorldMatrix(!1,!1);let n=e.geometry;if(n!==void 0){let r=n.getAttribute("position");if(t===!0&&r!==void 0&&e.isInstancedMesh!==!0&&e.isBatchedMesh!==!0)for(let o=0,a=r.count;o<a;o++)e.isMesh===!0?e.getVertexPosition(o,Jn):Jn.fromBufferAttribute(r,o),Jn.applyMatrix4(e.matrixWorld),this.expandByPoint(Jn);else e.boundingBox!==void 0?(e.boundingBox===null&&e.computeBoundingBox(),ra.copy(e.boundingBox)):(n.boundingBox===null&&n.computeBoundingBox(),ra.copy(n.boundingBox)),ra.applyMatrix4(e.matrixWorld),this.union(ra)}let s=e.children;for(let r=0,o=s.length;r<o;r++)this.expandByObject(s[r],t);return this}containsPoint(e){return e.x>=this.min.x&&e.x<=this.max.x&&e.y>=this.min.y&&e.y<=this.max.y&&e.z>=this.min.z&&e.z<=this.max.z}containsBox(e){return this.min.x<=e.min.x&&e.max.x<=this.max.x&&this.min.y<=e.min.y&&e.max.y<=this.max.y&&this.min.z<=e.min.z&&e.max.z<=this.max.z}getParameter(e,t){return t.set((e.x-this.min.x)/(this.max.x-this.min.x),(e.y-this.min.y)/(this.max.y-this.min.y),(e.z-this.min.z)/(this.max.z-this.min.z))}intersectsBox(e){return e.max.x>=this.min.x&&e.min.x<=this.max.x&&e.max.y>=this.min.y&&e.min.y<=this.max.y&&e.max.z>=this.min.z&&e.min.z<=this.max.z}intersectsSphere(e){return this.clampPoint(e.center,Jn),Jn.distanceToSquared(e.center)<=e.radius*e.radius}intersectsPlane(e){let t,n;return e.normal.x>0?(t=e.normal.x*this.min.x,n=e.normal.x*this.max.x):(t=e.normal.x*this.max.x,n=e.normal.x*this.min.x),e.normal.y>0?(t+=e.normal.y*this.min.y,n+=e.normal.y*this.max.y):(t+=e.normal.y*this.max.y,n+=e.normal.y*this.min.y),e.normal.z>0?(t+=e.normal.z*this.min.z,n+=e.normal.z*this.max.z):(t+=e.normal.z*this.max.z,n+=e.normal.z*this.min.z),t<=-e.constant&&n>=-e.constant}intersectsTriangle(e){if(this.isEmpty())return!1;this.getCenter(Fr),oa.subVectors(this.max,Fr),Cs.subVectors(e.a,Fr),Rs.subVectors(e.b,Fr),Ps.subVectors(e.c,Fr),Ui.subVectors(Rs,Cs),Fi.subVectors(Ps,Rs),rs.subVectors(Cs,Ps);let t=[0,-Ui.z,Ui.y,0,-Fi.z,Fi.y,0,-rs.z,rs.y,Ui.z,0,-Ui.x,Fi.z,0,-Fi.x,rs.z,0,-rs.x,-Ui.y,Ui.x,0,-Fi.y,Fi.x,0,-rs.y,rs.x,0];return!Yh(t,Cs,Rs,Ps,oa)||(t=[1,0,0,0,1,0,0,0,1],!Yh(t,Cs,Rs,Ps,oa))?!1:(aa.crossVectors(Ui,Fi),t=[aa.x,aa.y,aa.z],Yh(t,Cs,Rs,Ps,oa))}clampPoint(e,t){return t.copy(e).clamp(this.min,this.max)}distanceToPoint(e){return this.clampPoint(e,Jn).distanceTo(e)}getBoundingSphere(e){return this.isEmpty()?e.makeEmpty():(this.getCenter(e.center),e.radius=this.getSize(Jn).length()*.5),e}intersect(e){return this.min.max(e.min),this.max.min(e.max),this.isEmpty()&&this.makeEmpty(),this}union(e){return this.min.min(e.min),this.max.max(e.max),this}applyMatrix4(e){return this.isEmpty()?this:(bi[0].set(this.min.x,this.min.y,this.min.z).applyMatrix4(e),bi[1].set(this.min.x,this.min.y,this.max.z).applyMatrix4(e),bi[2].set(this.min.x,this.max.y,this.min.z).applyMatrix4(e),bi[3].set(this.min.x,this.max.y,this.max.z).applyMatrix4(e),bi[4].set(this.max.x,this.min.y,this.min.z).applyMatrix4(e),bi[5].set(this.max.x,this.min.y,this.max.z).applyMatrix4(e),bi[6].set(this.max.x,this.max.y,this.min.z).applyMatrix4(e),bi[7].set(this.max.x,this.max.y,this.max.z).applyMatrix4(e),this.setFromPoints(bi),this)}translate(e){return this.min.add(e),this.max.add(e),this}equals(e){return e.min.equals(this.min)&&e.max.equals(this.max)}toJSON(){return{min:this.min.toArray(),max:this.max.toArray()}}fromJSON(e){return this.min.fromArray(e.min),this.max.fromArray(e.max),this}},bi=[new C,new C,new C,new C,new C,new C,new C,new C],Jn=new C,ra=new st,Cs=new C,Rs=new C,Ps=new C,Ui=new C,Fi=new C,rs=new C,Fr=new C,oa=new C,aa=new C,os=new C;function Yh(i,e,t,n,s){for(let r=0,o=i.length-3;r<=o;r+=3){os.fromArray(i,r);let a=s.x*Math.abs(os.x)+s.y*Math.abs(os.y)+s.z*Math.abs(os.z),l=e.dot(os),c=t.dot(os),h=n.dot(os);if(Math.max(-Math.max(l,c,h),Math.min(l,c,h))>a)return!1}return!0}var Nt=new C,la=new _e,Yy=0,Qe=class extends li{constructor(e,t,n=!1){if(super(),Array.isArray(e))throw new TypeError("THREE.BufferAttribute: array should be a Typed Array.");this.isBufferAttribute=!0,Object.defineProperty(this,"id",{value:Yy++}),this.name="",this.array=e,this.itemSize=t,this.count=e!==void 0?e.length/t:0,this.normalized=n,this.usage=Wu,this.updateRanges=[],this.gpuType=Cn,this.version=0,this._normalizationScale=e!==void 0?Jl(e):void 0}onUploadCallback(){}set needsUpdate(e){e===!0&&this.version++}setUsage(e){return this.usage=e,this}addUpdateRange(e,t){this.updateRanges.push({start:e,count:t})}clearUpdateRanges(){this.updateRanges.length=0}copy(e){return this.name=e.name,this.array=new e.array.constructor(e.array),this.itemSize=e.itemSize,this.count=e.count,this.normalized=e.normalized,this.usage=e.usage,this.gpuType=e.gpuType,this._normalizationScale=e._normalizationScale,this}copyAt(e,t,n){e*=this.itemSize,n*=t.itemSize;for(let s=0,r=this.itemSize;s<r;s++)this.array[e+s]=t.array[n+s];return this}copyArray(e){return this.array.set(e),this}applyMatrix3(e){if(this.itemSize===2)for(let t=0,n=this.count;t<n;t++)la.fromBufferAttribute(this,t),la.applyMatrix3(e),this.setXY(t,la.x,la.y);else if(this.itemSize===3)for(let t=0,n=this.count;t<n;t++)Nt.fromBufferAttribute(this,t),Nt.applyMatrix3(e),this.setXYZ(t,Nt.x,Nt.y,Nt.z);return this}applyMatrix4(e){for(let t=0,n=this.count;t<n;t++)Nt.fromBufferAttribute(this,t),Nt.applyMatrix4(e),this.setXYZ(t,Nt.x,Nt.y,Nt.z);return this}applyNormalMatrix(e){for(let t=0,n=this.count;t<n;t++)Nt.fromBufferAttribute(this,t),Nt.applyNormalMatrix(e),this.setXYZ(t,Nt.x,Nt.y,Nt.z);return this}transformDirection(e){for(let t=0,n=this.count;t<n;t++)Nt.fromBufferAttribute(this,t),Nt.transformDirection(e),this.setXYZ(t,Nt.x,Nt.y,Nt.z);return this}set(e,t=0){return this.array.set(e,t),this}getComponent(e,t){let n=this.array[e*this.itemSize+t];return this.normalized&&(n=this._denormalize(n)),n}setComponent(e,t,n){return this.normalized&&(n=this._normalize(n)),this.array[e*this.itemSize+t]=n,this}getX(e){let t=this.array[e*this.itemSize];return this.normalized&&(t=this._denormalize(t)),t}setX(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize]=t,this}getY(e){let t=this.array[e*this.itemSize+1];return this.normalized&&(t=this._denormalize(t)),t}setY(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize+1]=t,this}getZ(e){let t=this.array[e*this.itemSize+2];return this.normalized&&(t=this._denormalize(t)),t}setZ(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize+2]=t,this}getW(e){let t=this.array[e*this.itemSize+3];return this.normalized&&(t=this._denormalize(t)),t}setW(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize+3]=t,this}setXY(e,t,n){return e*=this.itemSize,this.normalized&&(t=this._normalize(t),n=this._normalize(n)),this.array[e+0]=t,this.array[e+1]=n,this}setXYZ(e,t,n,s){return e*=this.itemSize,this.normalized&&(t=this._normalize(t),n=this._normalize(n),s=this._normalize(s)),this.array[e+0]=t,this.array[e+1]=n,this.array[e+2]=s,this}setXYZW(e,t,n,s,r){return e*=this.itemSize,this.normalized&&(t=this._normalize(t),n=this._normalize(n),s=this._normalize(s),r=this._normalize(r)),this.array[e+0]=t,this.array[e+1]=n,this.array[e+2]=s,this.array[e+3]=r,this}onUpload(e){return this.onUploadCallback=e,this}clone(){return new this.constructor(this.array,this.itemSize).copy(this)}toJSON(){let e={itemSize:this.itemSize,type:this.array.constructor.name,array:Array.from(this.array),normalized:this.normalized};return e.name=this.name,e.usage=this.usage,e.gpuType=this.gpuType,e}dispose(){this.dispatchEvent({type:"dispose"})}_denormalize(e){let t=this._normalizationScale;return t!==void 0?Math.max(e/t,-1):Yu(e,this.array)}_normalize(e){let t=this._normalizationScale;return t!==void 0?Math.round(e*t):ju(e,this.array)}};var to=class extends Qe{constructor(e,t,n){super(new Uint16Array(e),t,n)}};var no=class extends Qe{constructor(e,t,n){super(new Uint32Array(e),t,n)}};var vt=class extends Qe{constructor(e,t,n){super(new Float32Array(e),t,n)}},jy=new st,Br=new C,jh=new C,Wt=class{constructor(e=new C,t=-1){this.isSphere=!0,this.center=e,this.radius=t}set(e,t){return this.center.copy(e),this.radius=t,this}setFromPoints(e,t){let n=this.center;t!==void 0?n.copy(t):jy.setFromPoints(e).getCenter(n);let s=0;for(let r=0,o=e.length;r<o;r++)s=Math.max(s,n.distanceToSquared(e[r]));return this.radius=Math.sqrt(s),this}copy(e){return this.center.copy(e.center),this.radius=e.radius,this}isEmpty(){return this.radius<0}makeEmpty(){return this.center.set(0,0,0),this.radius=-1,this}containsPoint(e){return e.distanceToSquared(this.center)<=this.radius*this.radius}distanceToPoint(e){return e.distanceTo(this.center)-this.radius}intersectsSphere(e){let t=this.radius+e.radius;return e.center.distanceToSquared(this.center)<=t*t}intersectsBox(e){return e.intersectsSphere(this)}intersectsPlane(e){return Math.abs(e.distanceToPoint(this.center))<=this.radius}clampPoint(e,t){let n=this.center.distanceToSquared(e);return t.copy(e),n>this.radius*this.radius&&(t.sub(this.center).normalize(),t.multiplyScalar(this.radius).add(this.center)),t}getBoundingBox(e){return this.isEmpty()?(e.makeEmpty(),e):(e.set(this.center,this.center),e.expandByScalar(this.radius),e)}applyMatrix4(e){return this.center.applyMatrix4(e),this.radius=this.radius*e.getMaxScaleOnAxis(),this}translate(e){return this.center.add(e),this}expandByPoint(e){if(this.isEmpty())return this.center.copy(e),this.radius=0,this;Br.subVectors(e,this.center);let t=Br.lengthSq();if(t>this.radius*this.radius){let n=Math.sqrt(t),s=(n-this.radius)*.5;this.center.addScaledVector(Br,s/n),this.radius+=s}return this}union(e){return e.isEmpty()?this:this.isEmpty()?(this.copy(e),this):(this.center.equals(e.center)===!0?this.radius=Math.max(this.radius,e.radius):(jh.subVectors(e.center,this.center).setLength(e.radius),this.expandByPoint(Br.copy(e.center).add(jh)),this.expandByPoint(Br.copy(e.center).sub(jh))),this)}equals(e){return e.center.equals(this.center)&&e.radius===this.radius}clone(){return new this.constructor().copy(this)}toJSON(){return{radius:this.radius,center:this.center.toArray()}}fromJSON(e){return this.radius=e.radius,this.center.fromArray(e.center),this}},Zy=0,Vn=new Le,Zh=new yn,Is=new C,En=new st,kr=new st,Ht=new C,rt=class i extends li{constructor(){super(),this.isBufferGeometry=!0,Object.defineProperty(this,"id",{value:Zy++}),this.uuid=qi(),this.name="",this.type="BufferGeometry",this.index=null,this.indirect=null,this.indirectOffset=0,this.attributes={},this.morphAttributes={},this.morphTargetsRelative=!1,this.groups=[],this.boundingBox=null,this.boundingSphere=null,this.drawRange={start:0,count:1/0},this.userData={},this._transformed=!1}getIndex(){return this.index}setIndex(e){return Array.isArray(e)?this.index=new(by(e)?no:to)(e,1):this.index=e,this}setIndirect(e,t=0){return this.indirect=e,this.indirectOffset=t,this}getIndirect(){return this.indirect}getAttribute(e){return this.attributes[e]}setAttribute(e,t){return this.attributes[e]=t,this}deleteAttribute(e){return delete this.attributes[e],this}hasAttribute(e){return this.attributes[e]!==void 0}addGroup(e,t,n=0){this.groups.push({start:e,count:t,materialIndex:n})}clearGroups(){this.groups=[]}setDrawRange(e,t){this.drawRange.start=e,this.drawRange.count=t}applyMatrix4(e){let t=this.attributes.position;t!==void 0&&(t.applyMatrix4(e),t.needsUpdate=!0);let n=this.attributes.normal;if(n!==void 0){let r=new Ue().getNormalMatrix(e);n.applyNormalMatrix(r),n.needsUpdate=!0}let s=this.attributes.tangent;return s!==void 0&&(s.transformDirection(e),s.needsUpdate=!0),this.boundingBox!==null&&this.computeBoundingBox(),this.boundingSphere!==null&&this.computeBoundingSphere(),this._transformed=!0,this}applyQuaternion(e){return Vn.makeRotationFromQuaternion(e),this.applyMatrix4(Vn),this}rotateX(e){return Vn.makeRotationX(e),this.applyMatrix4(Vn),this}rotateY(e){return Vn.makeRotationY(e),this.applyMatrix4(Vn),this}rotateZ(e){return Vn.makeRotationZ(e),this.applyMatrix4(Vn),this}translate(e,t,n){return Vn.makeTranslation(e,t,n),this.applyMatrix4(Vn),this}scale(e,t,n){return Vn.makeScale(e,t,n),this.applyMatrix4(Vn),this}lookAt(e){return Zh.lookAt(e),Zh.updateMatrix(),this.applyMatrix4(Zh.matrix),this}center(){return this.computeBoundingBox(),this.boundingBox.getCenter(Is).negate(),this.translate(Is.x,Is.y,Is.z),this}setFromPoints(e){let t=this.getAttribute("position");if(t===void 0){let n=[];for(let s=0,r=e.length;s<r;s++){let o=e[s];n.push(o.x,o.y,o.z||0)}this.setAttribute("position",new vt(n,3))}else{let n=Math.min(e.length,t.count);for(let s=0;s<n;s++){let r=e[s];t.setXYZ(s,r.x,r.y,r.z||0)}e.length>t.count&&Re("BufferGeometry: Buffer size too small for points data. Use .dispose() and create a new geometry."),t.needsUpdate=!0}return this}computeBoundingBox(){this.boundingBox===null&&(this.boundingBox=new st);let e=this.attributes.position,t=this.morphAttributes.position;if(e&&e.isGLBufferAttribute){Ne("BufferGeometry.computeBoundingBox(): GLBufferAttribute requires a manual bounding box.",this),this.boundingBox.set(new C(-1/0,-1/0,-1/0),new C(1/0,1/0,1/0));return}if(e!==void 0){if(this.boundingBox.setFromBufferAttribute(e),t)for(let n=0,s=t.length;n<s;n++){let r=t[n];En.setFromBufferAttribute(r),this.morphTargetsRelative?(Ht.addVectors(this.boundingBox.min,En.min),this.boundingBox.expandByPoint(Ht),Ht.addVectors(this.boundingBox.max,En.max),this.boundingBox.expandByPoint(Ht)):(this.boundingBox.expandByPoint(En.min),this.boundingBox.expandByPoint(En.max))}}else this.boundingBox.makeEmpty();(isNaN(this.boundingBox.min.x)||isNaN(this.boundingBox.min.y)||isNaN(this.boundingBox.min.z))&&Ne('BufferGeometry.computeBoundingBox(): Computed min/max have NaN values. The "position" attribute is likely to have NaN values.',this)}computeBoundingSphere(){this.boundingSphere===null&&(this.boundingSphere=new Wt);let e=this.attributes.position,t=this.morphAttributes.position;if(e&&e.isGLBufferAttribute){Ne("BufferGeometry.computeBoundingSphere(): GLBufferAttribute requires a manual bounding sphere.",this),this.boundingSphere.set(new C,1/0);return}if(e){let n=this.boundingSphere.center;if(En.setFromBufferAttribute(e),t)for(let r=0,o=t.length;r<o;r++){let a=t[r];kr.setFromBufferAttribute(a),this.morphTargetsRelative?(Ht.addVectors(En.min,kr.min),En.expandByPoint(Ht),Ht.addVectors(En.max,kr.max),En.expandByPoint(Ht)):(En.expandByPoint(kr.min),En.expandByPoint(kr.max))}En.getCenter(n);let s=0;for(let r=0,o=e.count;r<o;r++)Ht.fromBufferAttribute(e,r),s=Math.max(s,n.distanceToSquared(Ht));if(t)for(let r=0,o=t.length;r<o;r++){let a=t[r],l=this.morphTargetsRelative;for(let c=0,h=a.count;c<h;c++)Ht.fromBufferAttribute(a,c),l&&(Is.fromBufferAttribute(e,c),Ht.add(Is)),s=Math.max(s,n.distanceToSquared(Ht))}this.boundingSphere.radius=Math.sqrt(s),isNaN(this.boundingSphere.radius)&&Ne('BufferGeometry.computeBoundingSphere(): Computed radius is NaN. The "position" attribute is likely to have NaN values.',this)}}computeTangents(){let e=this.index,t=this.attributes;if(e===null||t.position===void 0||t.normal===void 0||t.uv===void 0){Ne("BufferGeometry: .computeTangents() failed. Missing required attributes (index, position, normal or uv)");return}let n=t.position,s=t.normal,r=t.uv,o=this.getAttribute("tangent");(o===void 0||o.count!==n.count)&&(o=new Qe(new Float32Array(4*n.count),4),this.setAttribute("tangent",o));let a=[],l=[],c=new Uint8Array(n.count);for(let N=0;N<n.count;N++)a[N]=new C,l[N]=new C;let h=new C,u=new C,d=new C,f=new _e,p=new _e,v=new _e,m=new C,g=new C;function x(N,E,R){c[N]=c[E]=c[R]=1,h.fromBufferAttribute(n,N),u.fromBufferAttribute(n,E),d.fromBufferAttribute(n,R),f.fromBufferAttribute(r,N),p.fromBufferAttribute(r,E),v.fromBufferAttribute(r,R),u.sub(h),d.sub(h),p.sub(f),v.sub(f);let L=1/(p.x*v.y-v.x*p.y);isFinite(L)&&(m.copy(u).multiplyScalar(v.y).addScaledVector(d,-p.y).multiplyScalar(L),g.copy(d).multiplyScalar(p.x).addScaledVector(u,-v.x).multiplyScalar(L),a[N].add(m),a[E].add(m),a[R].add(m),l[N].add(g),l[E].add(g),l[R].add(g))}let b=this.groups;b.length===0&&(b=[{start:0,count:e.count}]);for(let N=0,E=b.length;N<E;++N){let R=b[N],L=R.start,O=R.count;for(let I=L,k=L+O;I<k;I+=3)x(e.getX(I+0),e.getX(I+1),e.getX(I+2))}let _=new C,M=new C,A=new C,y=new C;function S(N){A.fromBufferAttribute(s,N),y.copy(A);let E=a[N];_.copy(E),_.sub(A.multiplyScalar(A.dot(E))).normalize(),M.crossVectors(y,E);let L=M.dot(l[N])<0?-1:1;o.setXYZW(N,_.x,_.y,_.z,L)}for(let N=0,E=n.count;N<E;++N)c[N]&&S(N);this._transformed=!0}computeVertexNormals(){let e=this.index,t=this.getAttribute("position");if(t!==void 0){let n=this.getAttribute("normal");if(n===void 0||n.count!==t.count)n=new Qe(new Float32Array(t.count*3),3),this.setAttribute("normal",n);else for(let d=0,f=n.count;d<f;d++)n.setXYZ(d,0,0,0);let s=new C,r=new C,o=new C,a=new C,l=new C,c=new C,h=new C,u=new C;if(e)for(let d=0,f=e.count;d<f;d+=3){let p=e.getX(d+0),v=e.getX(d+1),m=e.getX(d+2);s.fromBufferAttribute(t,p),r.fromBufferAttribute(t,v),o.fromBufferAttribute(t,m),h.subVectors(o,r),u.subVectors(s,r),h.cross(u),a.fromBufferAttribute(n,p),l.fromBufferAttribute(n,v),c.fromBufferAttribute(n,m),a.add(h),l.add(h),c.add(h),n.setXYZ(p,a.x,a.y,a.z),n.setXYZ(v,l.x,l.y,l.z),n.setXYZ(m,c.x,c.y,c.z)}else for(let d=0,f=t.count;d<f;d+=3)s.fromBufferAttribute(t,d+0),r.fromBufferAttribute(t,d+1),o.fromBufferAttribute(t,d+2),h.subVectors(o,r),u.subVectors(s,r),h.cross(u),n.setXYZ(d+0,h.x,h.y,h.z),n.setXYZ(d+1,h.x,h.y,h.z),n.setXYZ(d+2,h.x,h.y,h.z);this.normalizeNormals(),n.needsUpdate=!0}}normalizeNormals(){let e=this.attributes.normal;for(let t=0,n=e.count;t<n;t++)Ht.fromBufferAttribute(e,t),Ht.normalize(),e.setXYZ(t,Ht.x,Ht.y,Ht.z)}toNonIndexed(){function e(a,l){let c=a.array,h=a.itemSize,u=a.normalized,d=new c.constructor(l.length*h),f=0,p=0;for(let v=0,m=l.length;v<m;v++){a.isInterleavedBufferAttribute?f=l[v]*a.data.stride+a.offset:f=l[v]*h;for(let g=0;g<h;g++)d[p++]=c[f++]}return new Qe(d,h,u)}if(this.index===null)return Re("BufferGeometry.toNonIndexed(): BufferGeometry is already non-indexed."),this;let t=new i,n=this.index.array,s=this.attributes;for(let a in s){let l=s[a],c=e(l,n);t.setAttribute(a,c)}let r=this.morphAttributes;for(let a in r){let l=[],c=r[a];for(let h=0,u=c.length;h<u;h++){let d=c[h],f=e(d,n);l.push(f)}t.morphAttributes[a]=l}t.morphTargetsRelative=this.morphTargetsRelative;let o=this.groups;for(let a=0,l=o.length;a<l;a++){let c=o[a];t.addGroup(c.start,c.count,c.materialIndex)}return t}toJSON(){let e={metadata:{version:4.7,type:"BufferGeometry",generator:"BufferGeometry.toJSON"}};if(e.uuid=this.uuid,e.type=this.parameters!==void 0&&this._transformed===!0?"BufferGeometry":this.type,e.name=this.name,Object.keys(this.userData).length>0&&(e.userData=this.userData),this.parameters!==void 0&&this._transformed!==!0){let l=this.parameters;for(let c in l)l[c]!==void 0&&(e[c]=l[c]);return e}e.data={attributes:{}};let t=this.index;t!==null&&(e.data.index={type:t.array.constructor.name,array:Array.prototype.slice.call(t.array)});let n=this.attributes;for(let l in n){let c=n[l];e.data.attributes[l]=c.toJSON(e.data)}let s={},r=!1;for(let l in this.morphAttributes){let c=this.morphAttributes[l],h=[];for(let u=0,d=c.length;u<d;u++){let f=c[u];h.push(f.toJSON(e.data))}h.length>0&&(s[l]=h,r=!0)}r&&(e.data.morphAttributes=s,e.data.morphTargetsRelative=this.morphTargetsRelative);let o=this.groups;o.length>0&&(e.data.groups=JSON.parse(JSON.stringify(o)));let a=this.boundingSphere;return a!==null&&(e.data.boundingSphere=a.toJSON()),e}clone(){return new this.constructor().copy(this)}copy(e){this.index=null,this.attributes={},this.morphAttributes={},this.groups=[],this.boundingBox=null,this.boundingSphere=null;let t={};this.name=e.name;let n=e.index;n!==null&&this.setIndex(n.clone());let s=e.attributes;for(let c in s){let h=s[c];this.setAttribute(c,h.clone(t))}let r=e.morphAttributes;for(let c in r){let h=[],u=r[c];for(let d=0,f=u.length;d<f;d++)h.push(u[d].clone(t));this.morphAttributes[c]=h}this.morphTargetsRelative=e.morphTargetsRelative;let o=e.groups;for(let c=0,h=o.length;c<h;c++){let u=o[c];this.addGroup(u.start,u.count,u.materialIndex)}let a=e.boundingBox;a!==null&&(this.boundingBox=a.clone());let l=e.boundingSphere;return l!==null&&(this.boundingSphere=l.clone()),this.drawRange.start=e.drawRange.start,this.drawRange.count=e.drawRange.count,this.userData=e.userData,this._transformed=e._transformed,this}dispose(){this.dispatchEvent({type:"dispose"})}},ja=class{constructor(e,t){this.isInterleavedBuffer=!0,this.array=e,this.stride=t,this.count=e!==void 0?e.length/t:0,this.usage=Wu,this.updateRanges=[],this.version=0,this.uuid=qi()}onUploadCallback(){}set needsUpdate(e){e===!0&&this.version++}setUsage(e){return this.usage=e,this}addUpdateRange(e,t){this.updateRanges.push({start:e,count:t})}clearUpdateRanges(){this.updateRanges.length=0}copy(e){return this.array=new e.array.constructor(e.array),this.count=e.count,this.stride=e.stride,this.usage=e.usage,this}copyAt(e,t,n){e*=this.stride,n*=t.stride;for(let s=0,r=this.stride;s<r;s++)this.array[e+s]=t.array[n+s];return this}set(e,t=0){return this.array.set(e,t),this}clone(e){e.arrayBuffers===void 0&&(e.arrayBuffers={});let t=Vf(this.array);e.arrayBuffers[t]===void 0&&(e.arrayBuffers[t]=this.array.slice(0).buffer);let n=new this.array.constructor(e.arrayBuffers[t]),s=new this.constructor(n,this.stride);return s.setUsage(this.usage),s}onUpload(e){return this.onUploadCallback=e,this}toJSON(e){e.arrayBuffers===void 0&&(e.arrayBuffers={});let t=Vf(this.array);e.arrayBuffers[t]===void 0&&(e.arrayBuffers[t]=Array.from(new Uint32Array(this.array.slice(0).buffer)));let n={uuid:this.uuid,buffer:t,type:this.array.constructor.name,stride:this.stride};return n.usage=this.usage,n}};function Vf(i){return i.buffer._uuid===void 0&&(i.buffer._uuid=qi()),i.byteOffset===0&&i.byteLength===i.buffer.byteLength?i.buffer._uuid:i.buffer._uuid+":"+i.byteOffset+":"+i.byteLength}var un=new C,io=class i{constructor(e,t,n,s=!1){this.isInterleavedBufferAttribute=!0,this.name="",this.data=e,this.itemSize=t,this.offset=n,this.normalized=s,this._normalizationScale=e!==void 0?Jl(e.array):void 0}get count(){return this.data.count}get array(){return this.data.array}set needsUpdate(e){this.data.needsUpdate=e}applyMatrix4(e){for(let t=0,n=this.data.count;t<n;t++)un.fromBufferAttribute(this,t),un.applyMatrix4(e),this.setXYZ(t,un.x,un.y,un.z);return this}applyNormalMatrix(e){for(let t=0,n=this.count;t<n;t++)un.fromBufferAttribute(this,t),un.applyNormalMatrix(e),this.setXYZ(t,un.x,un.y,un.z);return this}transformDirection(e){for(let t=0,n=this.count;t<n;t++)un.fromBufferAttribute(this,t),un.transformDirection(e),this.setXYZ(t,un.x,un.y,un.z);return this}getComponent(e,t){let n=this.array[e*this.data.stride+this.offset+t];return this.normalized&&(n=this._denormalize(n)),n}setComponent(e,t,n){return this.normalized&&(n=this._normalize(n)),this.data.array[e*this.data.stride+this.offset+t]=n,this}setX(e,t){return this.normalized&&(t=this._normalize(t)),this.data.array[e*this.data.stride+this.offset]=t,this}setY(e,t){return this.normalized&&(t=this._normalize(t)),this.data.array[e*this.data.stride+this.offset+1]=t,this}setZ(e,t){return this.normalized&&(t=this._normalize(t)),this.data.array[e*this.data.stride+this.offset+2]=t,this}setW(e,t){return this.normalized&&(t=this._normalize(t)),this.data.array[e*this.data.stride+this.offset+3]=t,this}getX(e){let t=this.data.array[e*this.data.stride+this.offset];return this.normalized&&(t=this._denormalize(t)),t}getY(e){let t=this.data.array[e*this.data.stride+this.offset+1];return this.normalized&&(t=this._denormalize(t)),t}getZ(e){let t=this.data.array[e*this.data.stride+this.offset+2];return this.normalized&&(t=this._denormalize(t)),t}getW(e){let t=this.data.array[e*this.data.stride+this.offset+3];return this.normalized&&(t=this._denormalize(t)),t}setXY(e,t,n){return e=e*this.data.stride+this.offset,this.normalized&&(t=this._normalize(t),n=this._normalize(n)),this.data.array[e+0]=t,this.data.array[e+1]=n,this}setXYZ(e,t,n,s){return e=e*this.data.stride+this.offset,this.normalized&&(t=this._normalize(t),n=this._normalize(n),s=this._normalize(s)),this.data.array[e+0]=t,this.data.array[e+1]=n,this.data.array[e+2]=s,this}setXYZW(e,t,n,s,r){return e=e*this.data.stride+this.offset,this.normalized&&(t=this._normalize(t),n=this._normalize(n),s=this._normalize(s),r=this._normalize(r)),this.data.array[e+0]=t,this.data.array[e+1]=n,this.data.array[e+2]=s,this.data.array[e+3]=r,this}clone(e){if(e===void 0){Qr("InterleavedBufferAttribute.clone(): Cloning an interleaved buffer attribute will de-interleave buffer data.");let t=[];for(let n=0;n<this.count;n++){let s=n*this.data.stride+this.offset;for(let r=0;r<this.itemSize;r++)t.push(this.data.array[s+r])}return new Qe(new this.array.constructor(t),this.itemSize,this.normalized)}else return e.interleavedBuffers===void 0&&(e.interleavedBuffers={}),e.interleavedBuffers[this.data.uuid]===void 0&&(e.interleavedBuffers[this.data.uuid]=this.data.clone(e)),new i(e.interleavedBuffers[this.data.uuid],this.itemSize,this.offset,this.normalized)}toJSON(e){if(e===void 0){Qr("InterleavedBufferAttribute.toJSON(): Serializing an interleaved buffer attribute will de-interleave buffer data.");let t=[];for(let n=0;n<this.count;n++){let s=n*this.data.stride+this.offset;for(let r=0;r<this.itemSize;r++)t.push(this.data.array[s+r])}return{itemSize:this.itemSize,type:this.array.constructor.name,array:t,normalized:this.normalized}}else return e.interleavedBuffers===void 0&&(e.interleavedBuffers={}),e.interleavedBuffers[this.data.uuid]===void 0&&(e.interleavedBuffers[this.data.uuid]=this.data.toJSON(e)),{isInterleavedBufferAttribute:!0,itemSize:this.itemSize,data:this.data.uuid,offset:this.offset,normalized:this.normalized}}_denormalize(e){let t=this._normalizationScale;return t!==void 0?Math.max(e/t,-1):Yu(e,this.data.array)}_normalize(e){let t=this._normalizationScale;return t!==void 0?Math.round(e*t):ju(e,this.data.array)}},Jh=new C,Jy=new C,Ky=new Ue,St=class{constructor(e=new C(1,0,0),t=0){this.isPlane=!0,this.normal=e,this.constant=t}set(e,t){return this.normal.copy(e),this.constant=t,this}setComponents(e,t,n,s){return this.normal.set(e,t,n),this.constant=s,this}setFromNormalAndCoplanarPoint(e,t){return this.normal.copy(e),this.constant=-t.dot(this.normal),this}setFromCoplanarPoints(e,t,n){let s=Jh.subVectors(n,t).cross(Jy.subVectors(e,t)).normalize();return this.setFromNormalAndCoplanarPoint(s,e),this}copy(e){return this.normal.copy(e.normal),this.constant=e.constant,this}normalize(){let e=1/this.normal.length();return this.normal.multiplyScalar(e),this.constant*=e,this}negate(){return this.constant*=-1,this.normal.negate(),this}distanceToPoint(e){return this.normal.dot(e)+this.constant}distanceToSphere(e){return this.distanceToPoint(e.center)-e.radius}projectPoint(e,t){return t.copy(e).addScaledVector(this.normal,-this.distanceToPoint(e))}intersectLine(e,t,n=!0){let s=e.delta(Jh),r=this.normal.dot(s);if(r===0)return this.distanceToPoint(e.start)===0?t.copy(e.start):null;let o=-(e.start.dot(this.normal)+this.constant)/r;return n===!0&&(o<0||o>1)?null:t.copy(e.start).addScaledVector(s,o)}intersectsLine(e){let t=this.distanceToPoint(e.start),n=this.distanceToPoint(e.end);return t<0&&n>0||n<0&&t>0}intersectsBox(e){return e.intersectsPlane(this)}intersectsSphere(e){return e.intersectsPlane(this)}coplanarPoint(e){return e.copy(this.normal).multiplyScalar(-this.constant)}applyMatrix4(e,t){let n=t||Ky.getNormalMatrix(e),s=this.coplanarPoint(Jh).applyMatrix4(e),r=this.normal.applyMatrix3(n).normalize();return this.constant=-s.dot(r),this}translate(e){return this.constant-=e.dot(this.normal),this}equals(e){return e.normal.equals(this.normal)&&e.constant===this.constant}clone(){return new this.constructor().copy(this)}toJSON(){return{normal:this.normal.toArray(),constant:this.constant}}fromJSON(e){return this.normal.fromArray(e.normal),this.constant=e.constant,this}},Qy=0,ci=class extends li{constructor(){super(),this.isMaterial=!0,Object.defineProperty(this,"id",{value:Qy++}),this.uuid=qi(),this.name="",this.type="Material",this.blending=sr,this.side=Nn,this.vertexColors=!1,this.opacity=1,this.transparent=!1,this.alphaHash=!1,this.blendSrc=Mu,this.blendDst=Su,this.blendEquation=fs,this.blendSrcAlpha=null,this.blendDstAlpha=null,this.blendEquationAlpha=null,this.blendColor=new De(0,0,0),this.blendAlpha=0,this.depthFunc=Gs,this.depthTest=!0,this.depthWrite=!0,this.stencilWriteMask=255,this.stencilFunc=kp,this.stencilRef=0,this.stencilFuncMask=255,this.stencilFail=Oa,this.stencilZFail=Oa,this.stencilZPass=Oa,this.stencilWrite=!1,this.clippingPlanes=null,this.clipIntersection=!1,this.clipShadows=!1,this.shadowSide=null,this.colorWrite=!0,this.precision=null,this.polygonOffset=!1,this.polygonOffsetFactor=0,this.polygonOffsetUnits=0,this.dithering=!1,this.alphaToCoverage=!1,this.premultipliedAlpha=!1,this.forceSinglePass=!1,this.allowOverride=!0,this.visible=!0,this.toneMapped=!0,this.userData={},this.version=0,this._alphaTest=0}get alphaTest(){return this._alphaTest}set alphaTest(e){this._alphaTest>0!=e>0&&this.version++,this._alphaTest=e}onBeforeRender(){}onBeforeCompile(){}customProgramCacheKey(){return this.onBeforeCompile.toString()}setValues(e){if(e!==void 0)for(let t in e){let n=e[t];if(n===void 0){Re(`Material: parameter '${t}' has value of undefined.`);continue}let s=this[t];if(s===void 0){Re(`Material: '${t}' is not a property of THREE.${this.type}.`);continue}s&&s.isColor?s.set(n):s&&s.isVector2&&n&&n.isVector2||s&&s.isEuler&&n&&n.isEuler||s&&s.isVector3&&n&&n.isVector3?s.copy(n):this[t]=n}}toJSON(e){let t=e===void 0||typeof e=="string";t&&(e={textures:{},images:{}});let n={metadata:{version:4.7,type:"Material",generator:"Material.toJSON"}};n.uuid=this.uuid,n.type=this.type,n.blending=this.blending,n.side=this.side,n.shadowSide=this.shadowSide,n.vertexColors=this.vertexColors,n.opacity=this.opacity,n.transparent=this.transparent,n.blendSrc=this.blendSrc,n.blendDst=this.blendDst,n.blendEquation=this.blendEquation,n.blendSrcAlpha=this.blendSrcAlpha,n.blendDstAlpha=this.blendDstAlpha,n.blendEquationAlpha=this.blendEquationAlpha,n.blendColor=this.blendColor.getHex(),n.blendAlpha=this.blendAlpha,n.depthFunc=this.depthFunc,n.depthTest=this.depthTest,n.depthWrite=this.depthWrite,n.colorWrite=this.colorWrite,n.clipIntersection=this.clipIntersection,n.clipShadows=this.clipShadows,n.stencilWriteMask=this.stencilWriteMask,n.stencilFunc=this.stencilFunc,n.stencilRef=this.stencilRef,n.stencilFuncMask=this.stencilFuncMask,n.stencilFail=this.stencilFail,n.stencilZFail=this.stencilZFail,n.stencilZPass=this.stencilZPass,n.stencilWrite=this.stencilWrite,n.polygonOffset=this.polygonOffset,n.polygonOffsetFactor=this.polygonOffsetFactor,n.polygonOffsetUnits=this.polygonOffsetUnits,n.dithering=this.dithering,n.alphaTest=this.alphaTest,n.alphaHash=this.alphaHash,n.alphaToCoverage=this.alphaToCoverage,n.premultipliedAlpha=this.premultipliedAlpha,n.forceSinglePass=this.forceSinglePass,n.allowOverride=this.allowOverride,n.visible=this.visible,n.toneMapped=this.toneMapped,n.name=this.name,this.color&&this.color.isColor&&(n.color=this.color.getHex()),this.roughness!==void 0&&(n.roughness=this.roughness),this.metalness!==void 0&&(n.metalness=this.metalness),this.sheen!==void 0&&(n.sheen=this.sheen),this.sheenColor&&this.sheenColor.isColor&&(n.sheenColor=this.sheenColor.getHex()),this.sheenRoughness!==void 0&&(n.sheenRoughness=this.sheenRoughness),this.emissive&&this.emissive.isColor&&(n.emissive=this.emissive.getHex()),this.emissiveIntensity!==void 0&&(n.emissiveIntensity=this.emissiveIntensity),this.specular&&this.specular.isColor&&(n.specular=this.specular.getHex()),this.specularIntensity!==void 0&&(n.specularIntensity=this.specularIntensity),this.specularColor&&this.specularColor.isColor&&(n.specularColor=this.specularColor.getHex()),this.shininess!==void 0&&(n.shininess=this.shininess),this.clearcoat!==void 0&&(n.clearcoat=this.clearcoat),this.clearcoatRoughness!==void 0&&(n.clearcoatRoughness=this.clearcoatRoughness),this.diffuseRoughness!==void 0&&(n.diffuseRoughness=this.diffuseRoughness),this.diffuseRoughnessMap&&this.diffuseRoughnessMap.isTexture&&(n.diffuseRoughnessMap=this.diffuseRoughnessMap.toJSON(e).uuid),this.clearcoatMap&&this.clearcoatMap.isTexture&&(n.clearcoatMap=this.clearcoatMap.toJSON(e).uuid),this.clearcoatRoughnessMap&&this.clearcoatRoughnessMap.isTexture&&(n.clearcoatRoughnessMap=this.clearcoatRoughnessMap.toJSON(e).uuid),this.clearcoatNormalMap&&this.clearcoatNormalMap.isTexture&&(n.clearcoatNormalMap=this.clearcoatNormalMap.toJSON(e).uuid,n.clearcoatNormalScale=this.clearcoatNormalScale.toArray()),this.sheenColorMap&&this.sheenColorMap.isTexture&&(n.sheenColorMap=this.sheenColorMap.toJSON(e).uuid),this.sheenRoughnessMap&&this.sheenRoughnessMap.isTexture&&(n.sheenRoughnessMap=this.sheenRoughnessMap.toJSON(e).uuid),this.dispersion!==void 0&&(n.dispersion=this.dispersion),this.retroreflectivity!==void 0&&(n.retroreflectivity=this.retroreflectivity),this.iridescence!==void 0&&(n.iridescence=this.iridescence),this.iridescenceIOR!==void 0&&(n.iridescenceIOR=this.iridescenceIOR),this.iridescenceThicknessMinimum!==void 0&&(n.iridescenceThicknessMinimum=this.iridescenceThicknessMinimum),this.iridescenceThicknessMaximum!==void 0&&(n.iridescenceThicknessMaximum=this.iridescenceThicknessMaximum),this.iridescenceMap&&this.iridescenceMap.isTexture&&(n.iridescenceMap=this.iridescenceMap.toJSON(e).uuid),this.iridescenceThicknessMap&&this.iridescenceThicknessMap.isTexture&&(n.iridescenceThicknessMap=this.iridescenceThicknessMap.toJSON(e).uuid),this.anisotropy!==void 0&&(n.anisotropy=this.anisotropy),this.anisotropyRotation!==void 0&&(n.anisotropyRotation=this.anisotropyRotation),this.anisotropyMap&&this.anisotropyMap.isTexture&&(n.anisotropyMap=this.anisotropyMap.toJSON(e).uuid),this.map&&this.map.isTexture&&(n.map=this.map.toJSON(e).uuid),this.matcap&&this.matcap.isTexture&&(n.matcap=this.matcap.toJSON(e).uuid),this.alphaMap&&this.alphaMap.isTexture&&(n.alphaMap=this.alphaMap.toJSON(e).uuid),this.lightMap&&this.lightMap.isTexture&&(n.lightMap=this.lightMap.toJSON(e).uuid,n.lightMapIntensity=this.lightMapIntensity),this.aoMap&&this.aoMap.isTexture&&(n.aoMap=this.aoMap.toJSON(e).uuid,n.aoMapIntensity=this.aoMapIntensity),this.bumpMap&&this.bumpMap.isTexture&&(n.bumpMap=this.bumpMap.toJSON(e).uuid,n.bumpScale=this.bumpScale),this.normalMap&&this.normalMap.isTexture&&(n.normalMap=this.normalMap.toJSON(e).uuid,n.normalMapType=this.normalMapType,n.normalScale=this.normalScale.toArray()),this.displacementMap&&this.displacementMap.isTexture&&(n.displacementMap=this.displacementMap.toJSON(e).uuid,n.displacementScale=this.displacementScale,n.displacementBias=this.displacementBias),this.roughnessMap&&this.roughnessMap.isTexture&&(n.roughnessMap=this.roughnessMap.toJSON(e).uuid),this.metalnessMap&&this.metalnessMap.isTexture&&(n.metalnessMap=this.metalnessMap.toJSON(e).uuid),this.emissiveMap&&this.emissiveMap.isTexture&&(n.emissiveMap=this.emissiveMap.toJSON(e).uuid),this.specularMap&&this.specularMap.isTexture&&(n.specularMap=this.specularMap.toJSON(e).uuid),this.specularIntensityMap&&this.specularIntensityMap.isTexture&&(n.specularIntensityMap=this.specularIntensityMap.toJSON(e).uuid),this.specularColorMap&&this.specularColorMap.isTexture&&(n.specularColorMap=this.specularColorMap.toJSON(e).uuid),this.envMap&&this.envMap.isTexture&&(n.envMap=this.envMap.toJSON(e).uuid,this.combine!==void 0&&(n.combine=this.combine)),this.envMapRotation!==void 0&&(n.envMapRotation=this.envMapRotation.toArray()),this.envMapIntensity!==void 0&&(n.envMapIntensity=this.envMapIntensity),this.reflectivity!==void 0&&(n.reflectivity=this.reflectivity),this.refractionRatio!==void 0&&(n.refractionRatio=this.refractionRatio),this.gradientMap&&this.gradientMap.isTexture&&(n.gradientMap=this.gradientMap.toJSON(e).uuid),this.transmission!==void 0&&(n.transmission=this.transmission),this.transmissionMap&&this.transmissionMap.isTexture&&(n.transmissionMap=this.transmissionMap.toJSON(e).uuid),this.thickness!==void 0&&(n.thickness=this.thickness),this.thicknessMap&&this.thicknessMap.isTexture&&(n.thicknessMap=this.thicknessMap.toJSON(e).uuid),this.attenuationDistance!==void 0&&(n.attenuationDistance=this.attenuationDistance),this.attenuationColor!==void 0&&(n.attenuationColor=this.attenuationColor.getHex()),this.size!==void 0&&(n.size=this.size),this.sizeAttenuation!==void 0&&(n.sizeAttenuation=this.sizeAttenuation),Array.isArray(this.clippingPlanes)&&this.clippingPlanes.length>0&&(n.clippingPlanes=this.clippingPlanes.map(r=>r.toJSON())),this.rotation!==void 0&&(n.rotation=this.rotation),this.depthPacking!==void 0&&(n.depthPacking=this.depthPacking),this.linewidth!==void 0&&(n.linewidth=this.linewidth),this.linecap!==void 0&&(n.linecap=this.linecap),this.linejoin!==void 0&&(n.linejoin=this.linejoin),this.dashSize!==void 0&&(n.dashSize=this.dashSize),this.gapSize!==void 0&&(n.gapSize=this.gapSize),this.scale!==void 0&&(n.scale=this.scale),this.wireframe!==void 0&&(n.wireframe=this.wireframe),this.wireframeLinewidth!==void 0&&(n.wireframeLinewidth=this.wireframeLinewidth),this.wireframeLinecap!==void 0&&(n.wireframeLinecap=this.wireframeLinecap),this.wireframeLinejoin!==void 0&&(n.wireframeLinejoin=this.wireframeLinejoin),this.flatShading!==void 0&&(n.flatShading=this.flatShading),this.fog!==void 0&&(n.fog=this.fog),Object.keys(this.userData).length>0&&(n.userData=this.userData);function s(r){let o=[];for(let a in r){let l=r[a];delete l.metadata,o.push(l)}return o}if(t){let r=s(e.textures),o=s(e.images);r.length>0&&(n.textures=r),o.length>0&&(n.images=o)}return n}fromJSON(e,t){if(e.uuid!==void 0&&(this.uuid=e.uuid),e.name!==void 0&&(this.name=e.name),e.color!==void 0&&this.color!==void 0&&this.color.setHex(e.color),e.roughness!==void 0&&(this.roughness=e.roughness),e.metalness!==void 0&&(this.metalness=e.metalness),e.sheen!==void 0&&(this.sheen=e.sheen),e.sheenColor!==void 0&&(this.sheenColor=new De().setHex(e.sheenColor)),e.sheenRoughness!==void 0&&(this.sheenRoughness=e.sheenRoughness),e.emissive!==void 0&&this.emissive!==void 0&&this.emissive.setHex(e.emissive),e.specular!==void 0&&this.specular!==void 0&&this.specular.setHex(e.specular),e.specularIntensity!==void 0&&(this.specularIntensity=e.specularIntensity),e.specularColor!==void 0&&this.specularColor!==void 0&&this.specularColor.setHex(e.specularColor),e.shininess!==void 0&&(this.shininess=e.shininess),e.clearcoat!==void 0&&(this.clearcoat=e.clearcoat),e.clearcoatRoughness!==void 0&&(this.clearcoatRoughness=e.clearcoatRoughness),e.diffuseRoughness!==void 0&&(this.diffuseRoughness=e.diffuseRoughness),e.dispersion!==void 0&&(this.dispersion=e.dispersion),e.retroreflectivity!==void 0&&(this.retroreflectivity=e.retroreflectivity),e.iridescence!==void 0&&(this.iridescence=e.iridescence),e.iridescenceIOR!==void 0&&(this.iridescenceIOR=e.iridescenceIOR),e.iridescenceThicknessMinimum!==void 0&&(this.iridescenceThicknessMinimum=e.iridescenceThicknessMinimum),e.iridescenceThicknessMaximum!==void 0&&(this.iridescenceThicknessMaximum=e.iridescenceThicknessMaximum),e.iridescenceThicknessRange!==void 0&&(this.iridescenceThicknessMinimum=e.iridescenceThicknessRange[0],this.iridescenceThicknessMaximum=e.iridescenceThicknessRange[1]),e.transmission!==void 0&&(this.transmission=e.transmission),e.thickness!==void 0&&(this.thickness=e.thickness),e.attenuationDistance!==void 0&&(this.attenuationDistance=e.attenuationDistance),e.attenuationColor!==void 0&&this.attenuationColor!==void 0&&this.attenuationColor.setHex(e.attenuationColor),e.anisotropy!==void 0&&(this.anisotropy=e.anisotropy),e.anisotropyRotation!==void 0&&(this.anisotropyRotation=e.anisotropyRotation),e.fog!==void 0&&(this.fog=e.fog),e.flatShading!==void 0&&(this.flatShading=e.flatShading),e.blending!==void 0&&(this.blending=e.blending),e.combine!==void 0&&(this.combine=e.combine),e.side!==void 0&&(this.side=e.side),e.shadowSide!==void 0&&(this.shadowSide=e.shadowSide),e.opacity!==void 0&&(this.opacity=e.opacity),e.transparent!==void 0&&(this.transparent=e.transparent),e.alphaTest!==void 0&&(this.alphaTest=e.alphaTest),e.alphaHash!==void 0&&(this.alphaHash=e.alphaHash),e.depthFunc!==void 0&&(this.depthFunc=e.depthFunc),e.depthTest!==void 0&&(this.depthTest=e.depthTest),e.depthWrite!==void 0&&(this.depthWrite=e.depthWrite),e.colorWrite!==void 0&&(this.colorWrite=e.colorWrite),e.clippingPlanes!==void 0&&(this.clippingPlanes=e.clippingPlanes.map(n=>new St().fromJSON(n))),e.clipIntersection!==void 0&&(this.clipIntersection=e.clipIntersection),e.clipShadows!==void 0&&(this.clipShadows=e.clipShadows),e.depthPacking!==void 0&&(this.depthPacking=e.depthPacking),e.blendSrc!==void 0&&(this.blendSrc=e.blendSrc),e.blendDst!==void 0&&(this.blendDst=e.blendDst),e.blendEquation!==void 0&&(this.blendEquation=e.blendEquation),e.blendSrcAlpha!==void 0&&(this.blendSrcAlpha=e.blendSrcAlpha),e.blendDstAlpha!==void 0&&(this.blendDstAlpha=e.blendDstAlpha),e.blendEquationAlpha!==void 0&&(this.blendEquationAlpha=e.blendEquationAlpha),e.blendColor!==void 0&&this.blendColor!==void 0&&this.blendColor.setHex(e.blendColor),e.blendAlpha!==void 0&&(this.blendAlpha=e.blendAlpha),e.stencilWriteMask!==void 0&&(this.stencilWriteMask=e.stencilWriteMask),e.stencilFunc!==void 0&&(this.stencilFunc=e.stencilFunc),e.stencilRef!==void 0&&(this.stencilRef=e.stencilRef),e.stencilFuncMask!==void 0&&(this.stencilFuncMask=e.stencilFuncMask),e.stencilFail!==void 0&&(this.stencilFail=e.stencilFail),e.stencilZFail!==void 0&&(this.stencilZFail=e.stencilZFail),e.stencilZPass!==void 0&&(this.stencilZPass=e.stencilZPass),e.stencilWrite!==void 0&&(this.stencilWrite=e.stencilWrite),e.wireframe!==void 0&&(this.wireframe=e.wireframe),e.wireframeLinewidth!==void 0&&(this.wireframeLinewidth=e.wireframeLinewidth),e.wireframeLinecap!==void 0&&(this.wireframeLinecap=e.wireframeLinecap),e.wireframeLinejoin!==void 0&&(this.wireframeLinejoin=e.wireframeLinejoin),e.rotation!==void 0&&(this.rotation=e.rotation),e.linewidth!==void 0&&(this.linewidth=e.linewidth),e.linecap!==void 0&&(this.linecap=e.linecap),e.linejoin!==void 0&&(this.linejoin=e.linejoin),e.dashSize!==void 0&&(this.dashSize=e.dashSize),e.gapSize!==void 0&&(this.gapSize=e.gapSize),e.scale!==void 0&&(this.scale=e.scale),e.polygonOffset!==void 0&&(this.polygonOffset=e.polygonOffset),e.polygonOffsetFactor!==void 0&&(this.polygonOffsetFactor=e.polygonOffsetFactor),e.polygonOffsetUnits!==void 0&&(this.polygonOffsetUnits=e.polygonOffsetUnits),e.dithering!==void 0&&(this.dithering=e.dithering),e.alphaToCoverage!==void 0&&(this.alphaToCoverage=e.alphaToCoverage),e.premultipliedAlpha!==void 0&&(this.premultipliedAlpha=e.premultipliedAlpha),e.forceSinglePass!==void 0&&(this.forceSinglePass=e.forceSinglePass),e.allowOverride!==void 0&&(this.allowOverride=e.allowOverride),e.visible!==void 0&&(this.visible=e.visible),e.toneMapped!==void 0&&(this.toneMapped=e.toneMapped),e.userData!==void 0&&(this.userData=e.userData),e.vertexColors!==void 0&&(typeof e.vertexColors=="number"?this.vertexColors=e.vertexColors>0:this.vertexColors=e.vertexColors),e.size!==void 0&&(this.size=e.size),e.sizeAttenuation!==void 0&&(this.sizeAttenuation=e.sizeAttenuation),e.map!==void 0&&(this.map=t[e.map]||null),e.matcap!==void 0&&(this.matcap=t[e.matcap]||null),e.alphaMap!==void 0&&(this.alphaMap=t[e.alphaMap]||null),e.bumpMap!==void 0&&(this.bumpMap=t[e.bumpMap]||null),e.bumpScale!==void 0&&(this.bumpScale=e.bumpScale),e.normalMap!==void 0&&(this.normalMap=t[e.normalMap]||null),e.normalMapType!==void 0&&(this.normalMapType=e.normalMapType),e.normalScale!==void 0){let n=e.normalScale;Array.isArray(n)===!1&&(n=[n,n]),this.normalScale=new _e().fromArray(n)}return e.displacementMap!==void 0&&(this.displacementMap=t[e.displacementMap]||null),e.displacementScale!==void 0&&(this.displacementScale=e.displacementScale),e.displacementBias!==void 0&&(this.displacementBias=e.displacementBias),e.roughnessMap!==void 0&&(this.roughnessMap=t[e.roughnessMap]||null),e.metalnessMap!==void 0&&(this.metalnessMap=t[e.metalnessMap]||null),e.emissiveMap!==void 0&&(this.emissiveMap=t[e.emissiveMap]||null),e.emissiveIntensity!==void 0&&(this.emissiveIntensity=e.emissiveIntensity),e.specularMap!==void 0&&(this.specularMap=t[e.specularMap]||null),e.specularIntensityMap!==void 0&&(this.specularIntensityMap=t[e.specularIntensityMap]||null),e.specularColorMap!==void 0&&(this.specularColorMap=t[e.specularColorMap]||null),e.envMap!==void 0&&(this.envMap=t[e.envMap]||null),e.envMapRotation!==void 0&&this.envMapRotation.fromArray(e.envMapRotation),e.envMapIntensity!==void 0&&(this.envMapIntensity=e.envMapIntensity),e.reflectivity!==void 0&&(this.reflectivity=e.reflectivity),e.refractionRatio!==void 0&&(this.refractionRatio=e.refractionRatio),e.lightMap!==void 0&&(this.lightMap=t[e.lightMap]||null),e.lightMapIntensity!==void 0&&(this.lightMapIntensity=e.lightMapIntensity),e.aoMap!==void 0&&(this.aoMap=t[e.aoMap]||null),e.aoMapIntensity!==void 0&&(this.aoMapIntensity=e.aoMapIntensity),e.gradientMap!==void 0&&(this.gradientMap=t[e.gradientMap]||null),e.clearcoatMap!==void 0&&(this.clearcoatMap=t[e.clearcoatMap]||null),e.clearcoatRoughnessMap!==void 0&&(this.clearcoatRoughnessMap=t[e.clearcoatRoughnessMap]||null),e.clearcoatNormalMap!==void 0&&(this.clearcoatNormalMap=t[e.clearcoatNormalMap]||null),e.clearcoatNormalScale!==void 0&&(this.clearcoatNormalScale=new _e().fromArray(e.clearcoatNormalScale)),e.diffuseRoughnessMap!==void 0&&(this.diffuseRoughnessMap=t[e.diffuseRoughnessMap]||null),e.iridescenceMap!==void 0&&(this.iridescenceMap=t[e.iridescenceMap]||null),e.iridescenceThicknessMap!==void 0&&(this.iridescenceThicknessMap=t[e.iridescenceThicknessMap]||null),e.transmissionMap!==void 0&&(this.transmissionMap=t[e.transmissionMap]||null),e.thicknessMap!==void 0&&(this.thicknessMap=t[e.thicknessMap]||null),e.anisotropyMap!==void 0&&(this.anisotropyMap=t[e.anisotropyMap]||null),e.sheenColorMap!==void 0&&(this.sheenColorMap=t[e.sheenColorMap]||null),e.sheenRoughnessMap!==void 0&&(this.sheenRoughnessMap=t[e.sheenRoughnessMap]||null),this}clone(){return new this.constructor().copy(this)}copy(e){this.name=e.name,this.blending=e.blending,this.side=e.side,this.vertexColors=e.vertexColors,this.opacity=e.opacity,this.transparent=e.transparent,this.blendSrc=e.blendSrc,this.blendDst=e.blendDst,this.blendEquation=e.blendEquation,this.blendSrcAlpha=e.blendSrcAlpha,this.blendDstAlpha=e.blendDstAlpha,this.blendEquationAlpha=e.blendEquationAlpha,this.blendColor.copy(e.blendColor),this.blendAlpha=e.blendAlpha,this.depthFunc=e.depthFunc,this.depthTest=e.depthTest,this.depthWrite=e.depthWrite,this.stencilWriteMask=e.stencilWriteMask,this.stencilFunc=e.stencilFunc,this.stencilRef=e.stencilRef,this.stencilFuncMask=e.stencilFuncMask,this.stencilFail=e.stencilFail,this.stencilZFail=e.stencilZFail,this.stencilZPass=e.stencilZPass,this.stencilWrite=e.stencilWrite;let t=e.clippingPlanes,n=null;if(t!==null){let s=t.length;n=new Array(s);for(let r=0;r!==s;++r)n[r]=t[r].clone()}return this.clippingPlanes=n,this.clipIntersection=e.clipIntersection,this.clipShadows=e.clipShadows,this.shadowSide=e.shadowSide,this.colorWrite=e.colorWrite,this.precision=e.precision,this.polygonOffset=e.polygonOffset,this.polygonOffsetFactor=e.polygonOffsetFactor,this.polygonOffsetUnits=e.polygonOffsetUnits,this.dithering=e.dithering,this.alphaTest=e.alphaTest,this.alphaHash=e.alphaHash,this.alphaToCoverage=e.alphaToCoverage,this.premultipliedAlpha=e.premultipliedAlpha,this.forceSinglePass=e.forceSinglePass,this.allowOverride=e.allowOverride,this.visible=e.visible,this.toneMapped=e.toneMapped,this.userData=JSON.parse(JSON.stringify(e.userData)),this}dispose(){this.dispatchEvent({type:"dispose"})}set needsUpdate(e){e===!0&&this.version++}},Ys=class extends ci{constructor(e){super(),this.isSpriteMaterial=!0,this.type="SpriteMaterial",this.color=new De(16777215),this.map=null,this.alphaMap=null,this.rotation=0,this.sizeAttenuation=!0,this.transparent=!0,this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.alphaMap=e.alphaMap,this.rotation=e.rotation,this.sizeAttenuation=e.sizeAttenuation,this.fog=e.fog,this}},Ls,zr=new C,Ns=new C,Ds=new C,Os=new _e,Vr=new _e,Zp=new Le,ca=new C,Gr=new C,ha=new C,Gf=new _e,Kh=new _e,Hf=new _e,js=class extends yn{constructor(e=new Ys){if(super(),this.isSprite=!0,this.type="Sprite",Ls===void 0){Ls=new rt;let t=new Float32Array([-.5,-.5,0,0,0,.5,-.5,0,1,0,.5,.5,0,1,1,-.5,.5,0,0,1]),n=new ja(t,5);Ls.setIndex([0,1,2,0,2,3]),Ls.setAttribute("position",new io(n,3,0,!1)),Ls.setAttribute("uv",new io(n,2,3,!1))}this.geometry=Ls,this.material=e,this.center=new _e(.5,.5),this.count=1}intersectsFrustum(e){return e.intersectsSprite(this)}raycast(e,t){e.camera===null&&Ne('Sprite: "Raycaster.camera" needs to be set in order to raycast against sprites.'),Ns.setFromMatrixScale(this.matrixWorld),Zp.copy(e.camera.matrixWorld),this.modelViewMatrix.multiplyMatrices(e.camera.matrixWorldInverse,this.matrixWorld),Ds.setFromMatrixPosition(this.modelViewMatrix),e.camera.isPerspectiveCamera&&this.material.sizeAttenuation===!1&&Ns.multiplyScalar(-Ds.z);let n=this.material.rotation,s,r;n!==0&&(r=Math.cos(n),s=Math.sin(n));let o=this.center;ua(ca.set(-.5,-.5,0),Ds,o,Ns,s,r),ua(Gr.set(.5,-.5,0),Ds,o,Ns,s,r),ua(ha.set(.5,.5,0),Ds,o,Ns,s,r),Gf.set(0,0),Kh.set(1,0),Hf.set(1,1);let a=e.ray.intersectTriangle(ca,Gr,ha,!1,zr);if(a===null&&(ua(Gr.set(-.5,.5,0),Ds,o,Ns,s,r),Kh.set(0,1),a=e.ray.intersectTriangle(ca,ha,Gr,!1,zr),a===null))return;let l=e.ray.origin.distanceTo(zr);l<e.near||l>e.far||t.push({distance:l,point:zr.clone(),uv:Yt.getInterpolation(zr,ca,Gr,ha,Gf,Kh,Hf,new _e),face:null,object:this})}copy(e,t){return super.copy(e,t),e.center!==void 0&&this.center.copy(e.center),this.material=e.material,this}toJSON(e){let t=super.toJSON(e);return t.object.center=this.center.toArray(),t}};function ua(i,e,t,n,s,r){Os.subVectors(i,t).addScalar(.5).multiply(n),s!==void 0?(Vr.x=r*Os.x-s*Os.y,Vr.y=s*Os.x+r*Os.y):Vr.copy(Os),i.copy(e),i.x+=Vr.x,i.y+=Vr.y,i.applyMatrix4(Zp)}var Mi=new C,Qh=new C,da=new C,fa=new C,Kn=class{constructor(e=new C,t=new C(0,0,-1)){this.origin=e,this.direction=t}set(e,t){return this.origin.copy(e),this.direction.copy(t),this}copy(e){return this.origin.copy(e.origin),this.direction.copy(e.direction),this}at(e,t){return t.copy(this.origin).addScaledVector(this.direction,e)}lookAt(e){return this.direction.copy(e).sub(this.origin).normalize(),this}recast(e){return this.origin.copy(this.at(e,Mi)),this}closestPointToPoint(e,t){t.subVectors(e,this.origin);let n=t.dot(this.direction);return n<0?t.copy(this.origin):t.copy(this.origin).addScaledVector(this.direction,n)}distanceToPoint(e){return Math.sqrt(this.distanceSqToPoint(e))}distanceSqToPoint(e){let t=Mi.subVectors(e,this.origin).dot(this.direction);return t<0?this.origin.distanceToSquared(e):(Mi.copy(this.origin).addScaledVector(this.direction,t),Mi.distanceToSquared(e))}distanceSqToSegment(e,t,n,s){Qh.copy(e).add(t).multiplyScalar(.5),da.copy(t).sub(e).normalize(),fa.copy(this.origin).sub(Qh);let r=e.distanceTo(t)*.5,o=-this.direction.dot(da),a=fa.dot(this.direction),l=-fa.dot(da),c=fa.lengthSq(),h=Math.abs(1-o*o),u,d,f,p;if(h>0)if(u=o*l-a,d=o*a-l,p=r*h,u>=0)if(d>=-p)if(d<=p){let v=1/h;u*=v,d*=v,f=u*(u+o*d+2*a)+d*(o*u+d+2*l)+c}else d=r,u=Math.max(0,-(o*d+a)),f=-u*u+d*(d+2*l)+c;else d=-r,u=Math.max(0,-(o*d+a)),f=-u*u+d*(d+2*l)+c;else d<=-p?(u=Math.max(0,-(-o*r+a)),d=u>0?-r:Math.min(Math.max(-r,-l),r),f=-u*u+d*(d+2*l)+c):d<=p?(u=0,d=Math.min(Math.max(-r,-l),r),f=d*(d+2*l)+c):(u=Math.max(0,-(o*r+a)),d=u>0?r:Math.min(Math.max(-r,-l),r),f=-u*u+d*(d+2*l)+c);else d=o>0?-r:r,u=Math.max(0,-(o*d+a)),f=-u*u+d*(d+2*l)+c;return n&&n.copy(this.origin).addScaledVector(this.direction,u),s&&s.copy(Qh).addScaledVector(da,d),f}intersectSphere(e,t){if(e.radius<0)return null;Mi.subVectors(e.center,this.origin);let n=Mi.dot(this.direction),s=Mi.dot(Mi)-n*n,r=e.radius*e.radius;if(s>r)return null;let o=Math.sqrt(r-s),a=n-o,l=n+o;return l<0?null:a<0?this.at(l,t):this.at(a,t)}intersectsSphere(e){return e.radius<0?!1:this.distanceSqToPoint(e.center)<=e.radius*e.radius}distanceToPlane(e){let t=e.normal.dot(this.direction);if(t===0)return e.distanceToPoint(this.origin)===0?0:null;let n=-(this.origin.dot(e.normal)+e.constant)/t;return n>=0?n:null}intersectPlane(e,t){let n=this.distanceToPlane(e);return n===null?null:this.at(n,t)}intersectsPlane(e){let t=e.distanceToPoint(this.origin);return t===0||e.normal.dot(this.direction)*t<0}intersectBox(e,t){let n,s,r,o,a,l,c=1/this.direction.x,h=1/this.direction.y,u=1/this.direction.z,d=this.origin;return c>=0?(n=(e.min.x-d.x)*c,s=(e.max.x-d.x)*c):(n=(e.max.x-d.x)*c,s=(e.min.x-d.x)*c),h>=0?(r=(e.min.y-d.y)*h,o=(e.max.y-d.y)*h):(r=(e.max.y-d.y)*h,o=(e.min.y-d.y)*h),n>o||r>s||((r>n||isNaN(n))&&(n=r),(o<s||isNaN(s))&&(s=o),u>=0?(a=(e.min.z-d.z)*u,l=(e.max.z-d.z)*u):(a=(e.max.z-d.z)*u,l=(e.min.z-d.z)*u),n>l||a>s)||((a>n||n!==n)&&(n=a),(l<s||s!==s)&&(s=l),s<0)?null:this.at(n>=0?n:s,t)}intersectsBox(e){return this.intersectBox(e,Mi)!==null}intersectTriangle(e,t,n,s,r){let o=this.origin,a=this.direction,l=a.x,c=a.y,h=a.z,u=e.x-o.x,d=e.y-o.y,f=e.z-o.z,p=t.x-o.x,v=t.y-o.y,m=t.z-o.z,g=n.x-o.x,x=n.y-o.y,b=n.z-o.z,_=Math.abs(l),M=Math.abs(c),A=Math.abs(h),y,S,N,E,R,L,O,I,k,H,W,te;if(_>=M&&_>=A?(N=l,L=u,k=p,te=g,l>=0?(y=c,S=h,E=d,R=f,O=v,I=m,H=x,W=b):(y=h,S=c,E=f,R=d,O=m,I=v,H=b,W=x)):M>=A?(N=c,L=d,k=v,te=x,c>=0?(y=h,S=l,E=f,R=u,O=m,I=p,H=b,W=g):(y=l,S=h,E=u,R=f,O=p,I=m,H=g,W=b)):(N=h,L=f,k=m,te=b,h>=0?(y=l,S=c,E=u,R=d,O=p,I=v,H=g,W=x):(y=c,S=l,E=d,R=u,O=v,I=p,H=x,W=g)),N===0)return null;let q=y/N,Q=S/N,ee=1/N,be=E-q*L,Oe=R-Q*L,Z=O-q*k,he=I-Q*k,ve=H-q*te,Ce=W-Q*te,pe=ve*he-Ce*Z,Fe=be*Ce-Oe*ve,Rt=Z*Oe-he*be;if(s){if(pe<0||Fe<0||Rt<0)return null}else if((pe<0||Fe<0||Rt<0)&&(pe>0||Fe>0||Rt>0))return null;let Pe=pe+Fe+Rt;if(Pe===0)return null;let nt=ee*(pe*L+Fe*k+Rt*te);return(Pe>0?nt<0:nt>0)?null:this.at(nt/Pe,r)}applyMatrix4(e){return this.origin.applyMatrix4(e),this.direction.transformDirection(e),this}equals(e){return e.origin.equals(this.origin)&&e.direction.equals(this.direction)}clone(){return new this.constructor().copy(this)}},Ft=class extends ci{constructor(e){super(),this.isMeshBasicMaterial=!0,this.type="MeshBasicMaterial",this.color=new De(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new ki,this.combine=wu,this.reflectivity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.lightMap=e.lightMap,this.lightMapIntensity=e.lightMapIntensity,this.aoMap=e.aoMap,this.aoMapIntensity=e.aoMapIntensity,this.specularMap=e.specularMap,this.alphaMap=e.alphaMap,this.envMap=e.envMap,this.envMapRotation.copy(e.envMapRotation),this.combine=e.combine,this.reflectivity=e.reflectivity,this.refractionRatio=e.refractionRatio,this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this.wireframeLinecap=e.wireframeLinecap,this.wireframeLinejoin=e.wireframeLinejoin,this.fog=e.fog,this}},Wf=new Le,as=new Kn,pa=new Wt,Xf=new C,ma=new C,ga=new C,ya=new C,eu=new C,xa=new C,qf=new C,_a=new C,Ke=class extends yn{constructor(e=new rt,t=new Ft){super(),this.isMesh=!0,this.type="Mesh",this.geometry=e,this.material=t,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.count=1,this.updateMorphTargets()}copy(e,t){return super.copy(e,t),e.morphTargetInfluences!==void 0?this.morphTargetInfluences=e.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,e.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},e.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(e.material)?e.material.slice():e.material,this.geometry=e.geometry,this}updateMorphTargets(){let t=this.geometry.morphAttributes,n=Object.keys(t);if(n.length>0){let s=t[n[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){let a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}getVertexPosition(e,t){let n=this.geometry,s=n.attributes.position,r=n.morphAttributes.position,o=n.morphTargetsRelative;t.fromBufferAttribute(s,e);let a=this.morphTargetInfluences;if(r&&a){xa.set(0,0,0);for(let l=0,c=r.length;l<c;l++){let h=a[l],u=r[l];h!==0&&(eu.fromBufferAttribute(u,e),o?xa.addScaledVector(eu,h):xa.addScaledVector(eu.sub(t),h))}t.add(xa)}return t}intersectsFrustum(e){return e.intersectsObject(this)}raycast(e,t){let n=this.geometry,s=this.material,r=this.matrixWorld;s!==void 0&&(n.boundingSphere===null&&n.computeBoundingSphere(),pa.copy(n.boundingSphere),pa.applyMatrix4(r),as.copy(e.ray).recast(e.near),!(pa.containsPoint(as.origin)===!1&&(as.intersectSphere(pa,Xf)===null||as.origin.distanceToSquared(Xf)>(e.far-e.near)**2))&&(Wf.copy(r).invert(),as.copy(e.ray).applyMatrix4(Wf),!(n.boundingBox!==null&&as.intersectsBox(n.boundingBox)===!1)&&this._computeIntersections(e,t,as)))}_computeIntersections(e,t,n){let s,r=this.geometry,o=this.material,a=r.index,l=r.attributes.position,c=r.attributes.uv,h=r.attributes.uv1,u=r.attributes.normal,d=r.groups,f=r.drawRange;if(a!==null)if(Array.isArray(o))for(let p=0,v=d.length;p<v;p++){let m=d[p],g=o[m.materialIndex],x=Math.max(m.start,f.start),b=Math.min(a.count,Math.min(m.start+m.count,f.start+f.count));for(let _=x,M=b;_<M;_+=3){let A=a.getX(_),y=a.getX(_+1),S=a.getX(_+2);s=va(this,g,e,n,c,h,u,A,y,S),s&&(s.faceIndex=Math.floor(_/3),s.face.materialIndex=m.materialIndex,t.push(s))}}else{let p=Math.max(0,f.start),v=Math.min(a.count,f.start+f.count);for(let m=p,g=v;m<g;m+=3){let x=a.getX(m),b=a.getX(m+1),_=a.getX(m+2);s=va(this,o,e,n,c,h,u,x,b,_),s&&(s.faceIndex=Math.floor(m/3),t.push(s))}}else if(l!==void 0)if(Array.isArray(o))for(let p=0,v=d.length;p<v;p++){let m=d[p],g=o[m.materialIndex],x=Math.max(m.start,f.start),b=Math.min(l.count,Math.min(m.start+m.count,f.start+f.count));for(let _=x,M=b;_<M;_+=3){let A=_,y=_+1,S=_+2;s=va(this,g,e,n,c,h,u,A,y,S),s&&(s.faceIndex=Math.floor(_/3),s.face.materialIndex=m.materialIndex,t.push(s))}}else{let p=Math.max(0,f.start),v=Math.min(l.count,f.start+f.count);for(let m=p,g=v;m<g;m+=3){let x=m,b=m+1,_=m+2;s=va(this,o,e,n,c,h,u,x,b,_),s&&(s.faceIndex=Math.floor(m/3),t.push(s))}}}};function ex(i,e,t,n,s,r,o,a){let l;if(e.side===Zt?l=n.intersectTriangle(o,r,s,!0,a):l=n.intersectTriangle(s,r,o,e.side===Nn,a),l===null)return null;_a.copy(a),_a.applyMatrix4(i.matrixWorld);let c=t.ray.origin.distanceTo(_a);return c<t.near||c>t.far?null:{distance:c,point:_a.clone(),object:i}}function va(i,e,t,n,s,r,o,a,l,c){i.getVertexPosition(a,ma),i.getVertexPosition(l,ga),i.getVertexPosition(c,ya);let h=ex(i,e,t,n,ma,ga,ya,qf);if(h){let u=new C;Yt.getBarycoord(qf,ma,ga,ya,u),s&&(h.uv=Yt.getInterpolatedAttribute(s,a,l,c,u,new _e)),r&&(h.uv1=Yt.getInterpolatedAttribute(r,a,l,c,u,new _e)),o&&(h.normal=Yt.getInterpolatedAttribute(o,a,l,c,u,new C),h.normal.dot(n.direction)>0&&h.normal.multiplyScalar(-1));let d={a,b:l,c,normal:new C,materialIndex:0};Yt.getNormal(ma,ga,ya,d.normal),h.face=d,h.barycoord=u}return h}var wi=class extends mn{constructor(e=null,t=1,n=1,s,r,o,a,l,c=Dt,h=Dt,u,d){super(null,o,a,l,c,h,s,r,u,d),this.isDataTexture=!0,this.image={data:e,width:t,height:n},this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}};var ls=new Wt,tx=new _e(.5,.5),ba=new C,Vi=class{constructor(e=new St,t=new St,n=new St,s=new St,r=new St,o=new St){this.planes=[e,t,n,s,r,o]}set(e,t,n,s,r,o){let a=this.planes;return a[0].copy(e),a[1].copy(t),a[2].copy(n),a[3].copy(s),a[4].copy(r),a[5].copy(o),this}copy(e){let t=this.planes;for(let n=0;n<6;n++)t[n].copy(e.planes[n]);return this}setFromProjectionMatrix(e,t=Gn,n=!1){let s=this.planes,r=e.elements,o=r[0],a=r[1],l=r[2],c=r[3],h=r[4],u=r[5],d=r[6],f=r[7],p=r[8],v=r[9],m=r[10],g=r[11],x=r[12],b=r[13],_=r[14],M=r[15];if(s[0].setComponents(c-o,f-h,g-p,M-x).normalize(),s[1].setComponents(c+o,f+h,g+p,M+x).normalize(),s[2].setComponents(c+a,f+u,g+v,M+b).normalize(),s[3].setComponents(c-a,f-u,g-v,M-b).normalize(),n)s[4].setComponents(l,d,m,_).normalize(),s[5].setComponents(c-l,f-d,g-m,M-_).normalize();else if(s[4].setComponents(c-l,f-d,g-m,M-_).normalize(),t===Gn)s[5].setComponents(c+l,f+d,g+m,M+_).normalize();else if(t===Jr)s[5].setComponents(l,d,m,_).normalize();else throw new Error("THREE.Frustum.setFromProjectionMatrix(): Invalid coordinate system: "+t);return this}intersectsObject(e){if(e.boundingSphere!==void 0)e.boundingSphere===null&&e.computeBoundingSphere(),ls.copy(e.boundingSphere).applyMatrix4(e.matrixWorld);else{let t=e.geometry;t.boundingSphere===null&&t.computeBoundingSphere(),ls.copy(t.boundingSphere).applyMatrix4(e.matrixWorld)}return this.intersectsSphere(ls)}intersectsSprite(e){ls.center.set(0,0,0);let t=tx.distanceTo(e.center);return ls.radius=.7071067811865476+t,ls.applyMatrix4(e.matrixWorld),this.intersectsSphere(ls)}intersectsSphere(e){let t=this.planes,n=e.center,s=-e.radius;for(let r=0;r<6;r++)if(t[r].distanceToPoint(n)<s)return!1;return!0}intersectsBox(e){let t=this.planes;for(let n=0;n<6;n++){let s=t[n];if(ba.x=s.normal.x>0?e.max.x:e.min.x,ba.y=s.normal.y>0?e.max.y:e.min.y,ba.z=s.normal.z>0?e.max.z:e.min.z,s.distanceToPoint(ba)<0)return!1}return!0}containsPoint(e){let t=this.planes;for(let n=0;n<6;n++)if(t[n].distanceToPoint(e)<0)return!1;return!0}clone(){return new this.constructor().copy(this)}},$f=new Le,so=class i{constructor(){this.coordinateSystem=Gn,this._frustums=[],this._count=0}setFromArrayCamera(e){let t=e.cameras,n=this._frustums;for(let s=0;s<t.length;s++){let r=t[s];$f.multiplyMatrices(r.projectionMatrix,r.matrixWorldInverse),n[s]===void 0&&(n[s]=new Vi),n[s].setFromProjectionMatrix($f,r.coordinateSystem,r.reversedDepth)}return this._count=t.length,this}getFrustum(e){return this._frustums[e]}intersectsObject(e){let t=this._frustums;for(let n=0;n<this._count;n++)if(t[n].intersectsObject(e))return!0;return!1}intersectsSprite(e){let t=this._frustums;for(let n=0;n<this._count;n++)if(t[n].intersectsSprite(e))return!0;return!1}intersectsSphere(e){let t=this._frustums;for(let n=0;n<this._count;n++)if(t[n].intersectsSphere(e))return!0;return!1}intersectsBox(e){let t=this._frustums;for(let n=0;n<this._count;n++)if(t[n].intersectsBox(e))return!0;return!1}containsPoint(e){let t=this._frustums;for(let n=0;n<this._count;n++)if(t[n].containsPoint(e))return!0;return!1}copy(e){this.coordinateSystem=e.coordinateSystem;let t=this._frustums,n=e._frustums;for(let s=0;s<e._count;s++)t[s]===void 0&&(t[s]=new Vi),t[s].copy(n[s]);return this._count=e._count,this}clone(){return new i().copy(this)}};function tu(i,e){return i-e}function nx(i,e){return i.z-e.z}function ix(i,e){return e.z-i.z}var hu=class{constructor(){this.index=0,this.pool=[],this.list=[]}push(e,t,n,s){let r=this.pool,o=this.list;this.index>=r.length&&r.push({start:-1,count:-1,z:-1,index:-1});let a=r[this.index];o.push(a),this.index++,a.start=e,a.count=t,a.z=n,a.index=s}reset(){this.list.length=0,this.index=0}},Sn=new Le,sx=new De(1,1,1),rx=new Vi,ox=new so,Ma=new st,cs=new Wt,nu=new C,Yf=new C,jf=new C,ax=new C,iu=new hu,sn=new Ke,Sa=[];function lx(i,e,t=0){let n=e.itemSize;if(i.isInterleavedBufferAttribute||i.array.constructor!==e.array.constructor){let s=i.count;for(let r=0;r<s;r++)for(let o=0;o<n;o++)e.setComponent(r+t,o,i.getComponent(r,o))}else e.array.set(i.array,t*n);e.needsUpdate=!0}function ri(i,e){if(i.constructor!==e.constructor){let t=Math.min(i.length,e.length);for(let n=0;n<t;n++)e[n]=i[n]}else{let t=Math.min(i.length,e.length);e.set(new i.constructor(i.buffer,0,t))}}var ro=class extends Ke{constructor(e,t,n=t*2,s){super(new rt,s),this.isBatchedMesh=!0,this.perObjectFrustumCulled=!0,this.sortObjects=!0,this.boundingBox=null,this.boundingSphere=null,this.customSort=null,this._instanceInfo=[],this._geometryInfo=[],this._availableInstanceIds=[],this._availableGeometryIds=[],this._nextIndexStart=0,this._nextVertexStart=0,this._geometryCount=0,this._visibilityChanged=!0,this._geometryInitialized=!1,this._maxInstanceCount=e,this._maxVertexCount=t,this._maxIndexCount=n,this._multiDrawCounts=new Int32Array(e),this._multiDrawStarts=new Int32Array(e),this._multiDrawCount=0,this._multiDrawBytesPerElement=1,this._mergedDrawCounts=new Int32Array(e),this._mergedDrawStarts=new Int32Array(e),this._mergedDrawInstanceCounts=new Int32Array(e),this._mergedDrawCount=0,this._matricesTexture=null,this._indirectTexture=null,this._colorsTexture=null,this._previousMatricesTexture=null,this._initMatricesTexture(),this._initIndirectTexture()}get maxInstanceCount(){return this._maxInstanceCount}get instanceCount(){return this._instanceInfo.length-this._availableInstanceIds.length}get unusedVertexCount(){return this._maxVertexCount-this._nextVertexStart}get unusedIndexCount(){return this._maxIndexCount-this._nextIndexStart}_initMatricesTexture(){let e=Math.sqrt(this._maxInstanceCount*4);e=Math.ceil(e/4)*4,e=Math.max(e,4);let t=new Float32Array(e*e*4),n=new wi(t,e,e,Rn,Cn);this._matricesTexture=n}_initIndirectTexture(){let e=Math.sqrt(this._maxInstanceCount);e=Math.ceil(e);let t=new Uint32Array(e*e),n=new wi(t,e,e,Mo,Wn);this._indirectTexture=n}_initColorsTexture(){let e=Math.sqrt(this._maxInstanceCount);e=Math.ceil(e);let t=new Float32Array(e*e*4).fill(1),n=new wi(t,e,e,Rn,Cn);n.colorSpace=$e.workingColorSpace,this._colorsTexture=n}_initializeGeometry(e){let t=this.geometry,n=this._maxVertexCount,s=this._maxIndexCount;if(this._geometryInitialized===!1){for(let r in e.attributes){let o=e.getAttribute(r),{array:a,itemSize:l,normalized:c}=o,h=new a.constructor(n*l),u=new Qe(h,l,c);t.setAttribute(r,u)}if(e.getIndex()!==null){let r=n>65535?new Uint32Array(s):new Uint16Array(s);t.setIndex(new Qe(r,1))}this._geometryInitialized=!0}}_validateGeometry(e){let t=this.geometry;if(!!e.getIndex()!=!!t.getIndex())throw new Error('THREE.BatchedMesh: All geometries must consistently have "index".');for(let n in t.attributes){if(!e.hasAttribute(n))throw new Error(`THREE.BatchedMesh: Added geometry missing "${n}". All geometries must have consistent attributes.`);let s=e.getAttribute(n),r=t.getAttribute(n);if(s.itemSize!==r.itemSize||s.normalized!==r.normalized)throw new Error(`THREE.BatchedMesh: Added geometry attribute "${n}" has an inconsistent itemSize or normalized value.`)}}validateInstanceId(e){let t=this._instanceInfo;if(e<0||e>=t.length||t[e].active===!1)throw new Error(`THREE.BatchedMesh: Invalid instanceId ${e}. Instance is either out of range or has been deleted.`)}validateGeometryId(e){let t=this._geometryInfo;if(e<0||e>=t.length||t[e].active===!1)throw new Error(`THREE.BatchedMesh: Invalid geometryId ${e}. Geometry is either out of range or has been deleted.`)}setCustomSort(e){return this.customSort=e,this}computeBoundingBox(){this.boundingBox===null&&(this.boundingBox=new st);let e=this.boundingBox,t=this._instanceInfo;e.makeEmpty();for(let n=0,s=t.length;n<s;n++){if(t[n].active===!1)continue;let r=t[n].geometryIndex;this.getMatrixAt(n,Sn),this.getBoundingBoxAt(r,Ma).applyMatrix4(Sn),e.union(Ma)}}computeBoundingSphere(){this.boundingSphere===null&&(this.boundingSphere=new Wt);let e=this.boundingSphere,t=this._instanceInfo;e.makeEmpty();for(let n=0,s=t.length;n<s;n++){if(t[n].active===!1)continue;let r=t[n].geometryIndex;this.getMatrixAt(n,Sn),this.getBoundingSphereAt(r,cs).applyMatrix4(Sn),e.union(cs)}}addInstance(e){if(this._instanceInfo.length>=this.maxInstanceCount&&this._availableInstanceIds.length===0)throw new Error("THREE.BatchedMesh: Maximum item count reached.");let n={visible:!0,active:!0,geometryIndex:e},s=null;this._availableInstanceIds.length>0?(this._availableInstanceIds.sort(tu),s=this._availableInstanceIds.shift(),this._instanceInfo[s]=n):(s=this._instanceInfo.length,this._instanceInfo.push(n));let r=this._matricesTexture;Sn.identity().toArray(r.image.data,s*16),r.needsUpdate=!0;let o=this._colorsTexture;return o&&(sx.toArray(o.image.data,s*4),o.needsUpdate=!0),this._visibilityChanged=!0,s}addGeometry(e,t=-1,n=-1){this._initializeGeometry(e),this._validateGeometry(e);let s={vertexStart:-1,vertexCount:-1,reservedVertexCount:-1,indexStart:-1,indexCount:-1,reservedIndexCount:-1,start:-1,count:-1,boundingBox:null,boundingSphere:null,active:!0},r=this._geometryInfo;s.vertexStart=this._nextVertexStart,s.reservedVertexCount=t===-1?e.getAttribute("position").count:t;let o=e.getIndex();if(o!==null&&(s.indexStart=this._nextIndexStart,s.reservedIndexCount=n===-1?o.count:n),s.indexStart!==-1&&s.indexStart+s.reservedIndexCount>this._maxIndexCount||s.vertexStart+s.reservedVertexCount>this._maxVertexCount)throw new Error("THREE.BatchedMesh: Reserved space request exceeds the maximum buffer size.");let l;return this._availableGeometryIds.length>0?(this._availableGeometryIds.sort(tu),l=this._availableGeometryIds.shift(),r[l]=s):(l=this._geometryCount,this._geometryCount++,r.push(s)),this.setGeometryAt(l,e),this._nextIndexStart=s.indexStart+s.reservedIndexCount,this._nextVertexStart=s.vertexStart+s.reservedVertexCount,l}setGeometryAt(e,t){if(e>=this._geometryCount)throw new Error("THREE.BatchedMesh: Maximum geometry count reached.");this._validateGeometry(t);let n=this.geometry,s=n.getIndex()!==null,r=n.getIndex(),o=t.getIndex(),a=this._geometryInfo[e];if(s&&o.count>a.reservedIndexCount||t.attributes.position.count>a.reservedVertexCount)throw new Error("THREE.BatchedMesh: Reserved space not large enough for provided geometry.");let l=a.vertexStart,c=a.reservedVertexCount;a.vertexCount=t.getAttribute("position").count;for(let h in n.attributes){let u=t.getAttribute(h),d=n.getAttribute(h);lx(u,d,l);let f=u.itemSize;for(let p=u.count,v=c;p<v;p++){let m=l+p;for(let g=0;g<f;g++)d.setComponent(m,g,0)}d.needsUpdate=!0,d.addUpdateRange(l*f,c*f)}if(s){let h=a.indexStart,u=a.reservedIndexCount;a.indexCount=t.getIndex().count;for(let d=0;d<o.count;d++)r.setX(h+d,l+o.getX(d));for(let d=o.count,f=u;d<f;d++)r.setX(h+d,l);r.needsUpdate=!0,r.addUpdateRange(h,a.reservedIndexCount)}return a.start=s?a.indexStart:a.vertexStart,a.count=s?a.indexCount:a.vertexCount,a.boundingBox=null,t.boundingBox!==null&&(a.boundingBox=t.boundingBox.clone()),a.boundingSphere=null,t.boundingSphere!==null&&(a.boundingSphere=t.boundingSphere.clone()),this._visibilityChanged=!0,e}deleteGeometry(e){let t=this._geometryInfo;if(e>=t.length||t[e].active===!1)return this;let n=this._instanceInfo;for(let s=0,r=n.length;s<r;s++)n[s].active&&n[s].geometryIndex===e&&this.deleteInstance(s);return t[e].active=!1,this._availableGeometryIds.push(e),this._visibilityChanged=!0,this}deleteInstance(e){return this.validateInstanceId(e),this._instanceInfo[e].active=!1,this._availableInstanceIds.push(e),this._visibilityChanged=!0,this}optimize(){let e=0,t=0,n=this._geometryInfo,s=n.map((o,a)=>a).sort((o,a)=>n[o].vertexStart-n[a].vertexStart),r=this.geometry;for(let o=0,a=n.length;o<a;o++){let l=s[o],c=n[l];if(c.active!==!1){if(r.index!==null){if(c.indexStart!==t){let{indexStart:h,vertexStart:u,reservedIndexCount:d}=c,f=r.index,p=f.array,v=e-u;for(let m=h;m<h+d;m++)p[m]=p[m]+v;f.array.copyWithin(t,h,h+d),f.addUpdateRange(t,d),f.needsUpdate=!0,c.indexStart=t}t+=c.reservedIndexCount}if(c.vertexStart!==e){let{vertexStart:h,reservedVertexCount:u}=c,d=r.attributes;for(let f in d){let p=d[f],{array:v,itemSize:m}=p;v.copyWithin(e*m,h*m,(h+u)*m),p.addUpdateRange(e*m,u*m),p.needsUpdate=!0}c.vertexStart=e}e+=c.reservedVertexCount,c.start=r.index?c.indexStart:c.vertexStart}}return this._nextIndexStart=t,this._nextVertexStart=e,this._visibilityChanged=!0,this}getBoundingBoxAt(e,t){if(e>=this._geometryCount)return null;let n=this.geometry,s=this._geometryInfo[e];if(s.boundingBox===null){let r=new st,o=n.index,a=n.attributes.position;for(let l=s.start,c=s.start+s.count;l<c;l++){let h=l;o&&(h=o.getX(h)),r.expandByPoint(nu.fromBufferAttribute(a,h))}s.boundingBox=r}return t.copy(s.boundingBox),t}getBoundingSphereAt(e,t){if(e>=this._geometryCount)return null;let n=this.geometry,s=this._geometryInfo[e];if(s.boundingSphere===null){let r=new Wt;this.getBoundingBoxAt(e,Ma),Ma.getCenter(r.center);let o=n.index,a=n.attributes.position,l=0;for(let c=s.start,h=s.start+s.count;c<h;c++){let u=c;o&&(u=o.getX(u)),nu.fromBufferAttribute(a,u),l=Math.max(l,r.center.distanceToSquared(nu))}r.radius=Math.sqrt(l),s.boundingSphere=r}return t.copy(s.boundingSphere),t}setMatrixAt(e,t){this.validateInstanceId(e);let n=this._matricesTexture,s=this._matricesTexture.image.data;return t.toArray(s,e*16),n.needsUpdate=!0,this}getMatrixAt(e,t){return this.validateInstanceId(e),t.fromArray(this._matricesTexture.image.data,e*16)}setColorAt(e,t){return this.validateInstanceId(e),this._colorsTexture===null&&this._initColorsTexture(),t.toArray(this._colorsTexture.image.data,e*4),this._colorsTexture.needsUpdate=!0,this}getColorAt(e,t){return this.validateInstanceId(e),this._colorsTexture===null?t.isVector4?t.set(1,1,1,1):t.setRGB(1,1,1):t.fromArray(this._colorsTexture.image.data,e*4)}setVisibleAt(e,t){return this.validateInstanceId(e),this._instanceInfo[e].visible===t?this:(this._instanceInfo[e].visible=t,this._visibilityChanged=!0,this)}getVisibleAt(e){return this.validateInstanceId(e),this._instanceInfo[e].visible}setGeometryIdAt(e,t){return this.validateInstanceId(e),this.validateGeometryId(t),this._instanceInfo[e].geometryIndex=t,this._visibilityChanged=!0,this}getGeometryIdAt(e){return this.validateInstanceId(e),this._instanceInfo[e].geometryIndex}getGeometryRangeAt(e,t={}){this.validateGeometryId(e);let n=this._geometryInfo[e];return t.vertexStart=n.vertexStart,t.vertexCount=n.vertexCount,t.reservedVertexCount=n.reservedVertexCount,t.indexStart=n.indexStart,t.indexCount=n.indexCount,t.reservedIndexCount=n.reservedIndexCount,t.start=n.start,t.count=n.count,t}setInstanceCount(e){let t=this._availableInstanceIds,n=this._instanceInfo;for(t.sort(tu);t[t.length-1]===n.length-1;)n.pop(),t.pop();if(e<n.length)throw new Error(`THREE.BatchedMesh: Instance ids outside the range ${e} are being used. Cannot shrink instance count.`);let s=new Int32Array(e),r=new Int32Array(e);ri(this._multiDrawCounts,s),ri(this._multiDrawStarts,r),this._multiDrawCounts=s,this._multiDrawStarts=r;let o=new Int32Array(e),a=new Int32Array(e),l=new Int32Array(e);ri(this._mergedDrawCounts,o),ri(this._mergedDrawStarts,a),ri(this._mergedDrawInstanceCounts,l),this._mergedDrawCounts=o,this._mergedDrawStarts=a,this._mergedDrawInstanceCounts=l,this._maxInstanceCount=e;let c=this._indirectTexture,h=this._matricesTexture,u=this._colorsTexture;c.dispose(),this._initIndirectTexture(),ri(c.image.data,this._indirectTexture.image.data),h.dispose(),this._initMatricesTexture(),ri(h.image.data,this._matricesTexture.image.data),u&&(u.dispose(),this._initColorsTexture(),ri(u.image.data,this._colorsTexture.image.data)),this._previousMatricesTexture!==null&&(this._previousMatricesTexture.dispose(),this._previousMatricesTexture=null)}setGeometrySize(e,t){let n=[...this._geometryInfo].filter(a=>a.active);if(Math.max(...n.map(a=>a.vertexStart+a.reservedVertexCount))>e)throw new Error(`THREE.BatchedMesh: Geometry vertex values are being used outside the range ${e}. Cannot shrink further.`);if(this.geometry.index&&Math.max(...n.map(l=>l.indexStart+l.reservedIndexCount))>t)throw new Error(`THREE.BatchedMesh: Geometry index values are being used outside the range ${t}. Cannot shrink further.`);let r=this.geometry;r.dispose(),this._maxVertexCount=e,this._maxIndexCount=t,this._geometryInitialized&&(this._geometryInitialized=!1,this.geometry=new rt,this._initializeGeometry(r));let o=this.geometry;r.index&&ri(r.index.array,o.index.array);for(let a in r.attributes)ri(r.attributes[a].array,o.attributes[a].array);this._visibilityChanged=!0}raycast(e,t){let n=this._instanceInfo,s=this._geometryInfo,r=this.matrixWorld,o=this.geometry;sn.material=this.material,sn.geometry.index=o.index,sn.geometry.attributes=o.attributes,sn.geometry.boundingBox===null&&(sn.geometry.boundingBox=new st),sn.geometry.boundingSphere===null&&(sn.geometry.boundingSphere=new Wt);for(let a=0,l=n.length;a<l;a++){if(!n[a].visible||!n[a].active)continue;let c=n[a].geometryIndex,h=s[c];sn.geometry.setDrawRange(h.start,h.count),this.getMatrixAt(a,sn.matrixWorld).premultiply(r),this.getBoundingBoxAt(c,sn.geometry.boundingBox),this.getBoundingSphereAt(c,sn.geometry.boundingSphere),sn.raycast(e,Sa);for(let u=0,d=Sa.length;u<d;u++){let f=Sa[u];f.object=this,f.batchId=a,t.push(f)}Sa.length=0}sn.material=null,sn.geometry.index=null,sn.geometry.attributes={},sn.geometry.setDrawRange(0,1/0)}copy(e){return super.copy(e),this.geometry=e.geometry.clone(),this.perObjectFrustumCulled=e.perObjectFrustumCulled,this.sortObjects=e.sortObjects,this.boundingBox=e.boundingBox!==null?e.boundingBox.clone():null,this.boundingSphere=e.boundingSphere!==null?e.boundingSphere.clone():null,this._geometryInfo=e._geometryInfo.map(t=>({...t,boundingBox:t.boundingBox!==null?t.boundingBox.clone():null,boundingSphere:t.boundingSphere!==null?t.boundingSphere.clone():null})),this._instanceInfo=e._instanceInfo.map(t=>({...t})),this._availableInstanceIds=e._availableInstanceIds.slice(),this._availableGeometryIds=e._availableGeometryIds.slice(),this._nextIndexStart=e._nextIndexStart,this._nextVertexStart=e._nextVertexStart,this._geometryCount=e._geometryCount,this._maxInstanceCount=e._maxInstanceCount,this._maxVertexCount=e._maxVertexCount,this._maxIndexCount=e._maxIndexCount,this._geometryInitialized=e._geometryInitialized,this._multiDrawCounts=e._multiDrawCounts.slice(),this._multiDrawStarts=e._multiDrawStarts.slice(),this._multiDrawBytesPerElement=e._multiDrawBytesPerElement,this._mergedDrawCounts=e._mergedDrawCounts.slice(),this._mergedDrawStarts=e._mergedDrawStarts.slice(),this._mergedDrawInstanceCounts=e._mergedDrawInstanceCounts.slice(),this._indirectTexture=e._indirectTexture.clone(),this._indirectTexture.image.data=this._indirectTexture.image.data.slice(),this._matricesTexture=e._matricesTexture.clone(),this._matricesTexture.image.data=this._matricesTexture.image.data.slice(),e._colorsTexture!==null?(this._colorsTexture=e._colorsTexture.clone(),this._colorsTexture.image.data=this._colorsTexture.image.data.slice()):this._colorsTexture=null,this}dispose(){super.dispose(),this.geometry.dispose(),this._matricesTexture.dispose(),this._matricesTexture=null,this._indirectTexture.dispose(),this._indirectTexture=null,this._colorsTexture!==null&&(this._colorsTexture.dispose(),this._colorsTexture=null),this._previousMatricesTexture!==null&&(this._previousMatricesTexture.dispose(),this._previousMatricesTexture=null)}_updateDrawParameters(e,t,n,s="multiDraw"){if(!this._visibilityChanged&&!this.perObjectFrustumCulled&&!this.sortObjects)return;let r=t.getIndex(),o=r===null?1:r.array.BYTES_PER_ELEMENT,a=1;n.wireframe&&(a=2,o=t.attributes.position.count>65535?4:2);let l=this._instanceInfo,c=this._multiDrawStarts,h=this._multiDrawCounts,u=this._mergedDrawStarts,d=this._mergedDrawCounts,f=this._mergedDrawInstanceCounts,p=this._geometryInfo,v=this.perObjectFrustumCulled,m=this._indirectTexture,g=m.image.data,x=e.isArrayCamera?ox:rx;v&&(e.isArrayCamera?x.setFromArrayCamera(e):(Sn.multiplyMatrices(e.projectionMatrix,e.matrixWorldInverse).multiply(this.matrixWorld),x.setFromProjectionMatrix(Sn,e.coordinateSystem,e.reversedDepth)));let b=0,_=0;if(this.sortObjects){Sn.copy(this.matrixWorld).invert(),Yf.setFromMatrixPosition(e.matrixWorld).applyMatrix4(Sn),jf.set(0,0,-1).transformDirection(e.matrixWorld).transformDirection(Sn);for(let y=0,S=l.length;y<S;y++)if(l[y].visible&&l[y].active){let N=l[y].geometryIndex;this.getMatrixAt(y,Sn),this.getBoundingSphereAt(N,cs).applyMatrix4(Sn);let E=!1;if(v&&(E=!x.intersectsSphere(cs)),!E){let R=p[N],L=ax.subVectors(cs.center,Yf).dot(jf);iu.push(R.start,R.count,L,y)}}let M=iu.list,A=this.customSort;A===null?M.sort(n.transparent?ix:nx):A.call(this,M,e);for(let y=0,S=M.length;y<S;y++){let N=M[y],E=N.start*o*a,R=N.count*a;s==="merged"?_>0&&u[_-1]===E&&d[_-1]===R?f[_-1]++:(u[_]=E,d[_]=R,f[_]=1,_++):(c[b]=E,h[b]=R),g[b]=N.index,b++}iu.reset()}else for(let M=0,A=l.length;M<A;M++)if(l[M].visible&&l[M].active){let y=l[M].geometryIndex,S=!1;if(v&&(this.getMatrixAt(M,Sn),this.getBoundingSphereAt(y,cs).applyMatrix4(Sn),S=!x.intersectsSphere(cs)),!S){let N=p[y],E=N.start*o*a,R=N.count*a;s==="merged"?_>0&&u[_-1]===E&&d[_-1]===R?f[_-1]++:(u[_]=E,d[_]=R,f[_]=1,_++):(c[b]=E,h[b]=R),g[b]=M,b++}}m.needsUpdate=!0,this._multiDrawCount=b,this._mergedDrawCount=_,this._multiDrawBytesPerElement=o,this._visibilityChanged=!1}onBeforeRender(e,t,n,s,r){e.isWebGPURenderer===!0?(this._visibilityChanged||this.perObjectFrustumCulled||this.sortObjects)&&(this._indirectTexture.needsUpdate=!0):this._updateDrawParameters(n,s,r)}onBeforeShadow(e,t,n,s,r,o){e.isWebGPURenderer!==!0&&this._updateDrawParameters(s,r,o)}},xn=class extends ci{constructor(e){super(),this.isLineBasicMaterial=!0,this.type="LineBasicMaterial",this.color=new De(16777215),this.map=null,this.linewidth=1,this.linecap="round",this.linejoin="round",this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.linewidth=e.linewidth,this.linecap=e.linecap,this.linejoin=e.linejoin,this.fog=e.fog,this}},Za=new C,Ja=new C,Zf=new Le,Hr=new Kn,wa=new Wt,su=new C,Jf=new C,Hn=class extends yn{constructor(e=new rt,t=new xn){super(),this.isLine=!0,this.type="Line",this.geometry=e,this.material=t,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.updateMorphTargets()}copy(e,t){return super.copy(e,t),e.morphTargetInfluences!==void 0?this.morphTargetInfluences=e.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,e.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},e.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(e.material)?e.material.slice():e.material,this.geometry=e.geometry,this}computeLineDistances(){let e=this.geometry;if(e.index===null){let t=e.attributes.position,n=[0];for(let s=1,r=t.count;s<r;s++)Za.fromBufferAttribute(t,s-1),Ja.fromBufferAttribute(t,s),n[s]=n[s-1],n[s]+=Za.distanceTo(Ja);e.setAttribute("lineDistance",new vt(n,1))}else Re("Line.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}intersectsFrustum(e){return e.intersectsObject(this)}raycast(e,t){let n=this.geometry,s=this.matrixWorld,r=e.params.Line.threshold,o=n.drawRange;if(n.boundingSphere===null&&n.computeBoundingSphere(),wa.copy(n.boundingSphere),wa.applyMatrix4(s),wa.radius+=r,e.ray.intersectsSphere(wa)===!1)return;Zf.copy(s).invert(),Hr.copy(e.ray).applyMatrix4(Zf);let a=r/((this.scale.x+this.scale.y+this.scale.z)/3),l=a*a,c=this.isLineSegments?2:1,h=n.index,d=n.attributes.position;if(h!==null){let f=Math.max(0,o.start),p=Math.min(h.count,o.start+o.count);for(let v=f,m=p-1;v<m;v+=c){let g=h.getX(v),x=h.getX(v+1),b=Ta(this,e,Hr,l,g,x,v);b&&t.push(b)}if(this.isLineLoop){let v=h.getX(p-1),m=h.getX(f),g=Ta(this,e,Hr,l,v,m,p-1);g&&t.push(g)}}else{let f=Math.max(0,o.start),p=Math.min(d.count,o.start+o.count);for(let v=f,m=p-1;v<m;v+=c){let g=Ta(this,e,Hr,l,v,v+1,v);g&&t.push(g)}if(this.isLineLoop){let v=Ta(this,e,Hr,l,p-1,f,p-1);v&&t.push(v)}}}updateMorphTargets(){let t=this.geometry.morphAttributes,n=Object.keys(t);if(n.length>0){let s=t[n[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){let a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}};function Ta(i,e,t,n,s,r,o){let a=i.geometry.attributes.position;if(Za.fromBufferAttribute(a,s),Ja.fromBufferAttribute(a,r),t.distanceSqToSegment(Za,Ja,su,Jf)>n)return;su.applyMatrix4(i.matrixWorld);let c=e.ray.origin.distanceTo(su);if(!(c<e.near||c>e.far))return{distance:c,point:Jf.clone().applyMatrix4(i.matrixWorld),index:o,face:null,faceIndex:null,barycoord:null,object:i}}var Kf=new C,Qf=new C,Pn=class extends Hn{constructor(e,t){super(e,t),this.isLineSegments=!0,this.type="LineSegments"}computeLineDistances(){let e=this.geometry;if(e.index===null){let t=e.attributes.position,n=[];for(let s=0,r=t.count;s<r;s+=2)Kf.fromBufferAttribute(t,s),Qf.fromBufferAttribute(t,s+1),n[s]=s===0?0:n[s-1],n[s+1]=n[s]+Kf.distanceTo(Qf);e.setAttribute("lineDistance",new vt(n,1))}else Re("LineSegments.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}},Zs=class extends Hn{constructor(e,t){super(e,t),this.isLineLoop=!0,this.type="LineLoop"}},Ka=class extends ci{constructor(e){super(),this.isPointsMaterial=!0,this.type="PointsMaterial",this.color=new De(16777215),this.map=null,this.alphaMap=null,this.size=1,this.sizeAttenuation=!0,this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.alphaMap=e.alphaMap,this.size=e.size,this.sizeAttenuation=e.sizeAttenuation,this.fog=e.fog,this}},ep=new Le,uu=new Kn,Aa=new Wt,Ea=new C,Js=class extends yn{constructor(e=new rt,t=new Ka){super(),this.isPoints=!0,this.type="Points",this.geometry=e,this.material=t,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.updateMorphTargets()}copy(e,t){return super.copy(e,t),e.morphTargetInfluences!==void 0?this.morphTargetInfluences=e.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,e.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},e.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(e.material)?e.material.slice():e.material,this.geometry=e.geometry,this}intersectsFrustum(e){return e.intersectsObject(this)}raycast(e,t){let n=this.geometry,s=this.matrixWorld,r=e.params.Points.threshold,o=n.drawRange;if(n.boundingSphere===null&&n.computeBoundingSphere(),Aa.copy(n.boundingSphere),Aa.applyMatrix4(s),Aa.radius+=r,e.ray.intersectsSphere(Aa)===!1)return;ep.copy(s).invert(),uu.copy(e.ray).applyMatrix4(ep);let a=r/((this.scale.x+this.scale.y+this.scale.z)/3),l=a*a,c=n.index,u=n.attributes.position;if(c!==null){let d=Math.max(0,o.start),f=Math.min(c.count,o.start+o.count);for(let p=d,v=f;p<v;p++){let m=c.getX(p);Ea.fromBufferAttribute(u,m),tp(Ea,m,l,s,e,t,this)}}else{let d=Math.max(0,o.start),f=Math.min(u.count,o.start+o.count);for(let p=d,v=f;p<v;p++)Ea.fromBufferAttribute(u,p),tp(Ea,p,l,s,e,t,this)}}updateMorphTargets(){let t=this.geometry.morphAttributes,n=Object.keys(t);if(n.length>0){let s=t[n[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){let a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}};function tp(i,e,t,n,s,r,o){let a=uu.distanceSqToPoint(i);if(a<t){let l=new C;uu.closestPointToPoint(i,l),l.applyMatrix4(n);let c=s.ray.origin.distanceTo(l);if(c<s.near||c>s.far)return;r.push({distance:c,distanceToRay:Math.sqrt(a),point:l,index:e,face:null,faceIndex:null,barycoord:null,object:o})}}var oo=class extends mn{constructor(e=[],t=ps,n,s,r,o,a,l,c,h){super(e,t,n,s,r,o,a,l,c,h),this.isCubeTexture=!0,this.flipY=!1}get images(){return this.image}set images(e){this.image=e}},ao=class extends mn{constructor(e,t,n,s,r,o,a,l,c){super(e,t,n,s,r,o,a,l,c),this.isCanvasTexture=!0,this.needsUpdate=!0}};var Ai=class extends mn{constructor(e,t,n=Wn,s,r,o,a=Dt,l=Dt,c,h=Ti,u=1){if(h!==Ti&&h!==Ci)throw new Error("THREE.DepthTexture: format must be either THREE.DepthFormat or THREE.DepthStencilFormat");let d={width:e,height:t,depth:u};super(d,s,r,o,a,l,h,n,c),this.isDepthTexture=!0,this.flipY=!1,this.generateMipmaps=!1,this.compareFunction=null}copy(e){return super.copy(e),this.source=new Xs(Object.assign({},e.image)),this.compareFunction=e.compareFunction,this}toJSON(e){let t=super.toJSON(e);return t.compareFunction=this.compareFunction,t}},lo=class extends Ai{constructor(e,t=Wn,n=ps,s,r,o=Dt,a=Dt,l,c=Ti){let h={width:e,height:e,depth:1},u=[h,h,h,h,h,h];super(e,e,t,n,s,r,o,a,l,c),this.image=u,this.isCubeDepthTexture=!0,this.isCubeTexture=!0}get images(){return this.image}set images(e){this.image=e}},co=class extends mn{constructor(e=null){super(),this.sourceTexture=e,this.isExternalTexture=!0}copy(e){return super.copy(e),this.sourceTexture=e.sourceTexture,this}},Ks=class i extends rt{constructor(e=1,t=1,n=1,s=1,r=1,o=1){super(),this.type="BoxGeometry",this.parameters={width:e,height:t,depth:n,widthSegments:s,heightSegments:r,depthSegments:o};let a=this;s=Math.floor(s),r=Math.floor(r),o=Math.floor(o);let l=[],c=[],h=[],u=[],d=0,f=0;p("z","y","x",-1,-1,n,t,e,o,r,0),p("z","y","x",1,-1,n,t,-e,o,r,1),p("x","z","y",1,1,e,n,t,s,o,2),p("x","z","y",1,-1,e,n,-t,s,o,3),p("x","y","z",1,-1,e,t,n,s,r,4),p("x","y","z",-1,-1,e,t,-n,s,r,5),this.setIndex(l),this.setAttribute("position",new vt(c,3)),this.setAttribute("normal",new vt(h,3)),this.setAttribute("uv",new vt(u,2));function p(v,m,g,x,b,_,M,A,y,S,N){let E=_/y,R=M/S,L=_/2,O=M/2,I=A/2,k=y+1,H=S+1,W=0,te=0,q=new C;for(let Q=0;Q<H;Q++){let ee=Q*R-O;for(let be=0;be<k;be++){let Oe=be*E-L;q[v]=Oe*x,q[m]=ee*b,q[g]=I,c.push(q.x,q.y,q.z),q[v]=0,q[m]=0,q[g]=A>0?1:-1,h.push(q.x,q.y,q.z),u.push(be/y),u.push(1-Q/S),W+=1}}for(let Q=0;Q<S;Q++)for(let ee=0;ee<y;ee++){let be=d+ee+k*Q,Oe=d+ee+k*(Q+1),Z=d+(ee+1)+k*(Q+1),he=d+(ee+1)+k*Q;l.push(be,Oe,he),l.push(Oe,Z,he),te+=6}a.addGroup(f,te,N),f+=te,d+=W}}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new i(e.width,e.height,e.depth,e.widthSegments,e.heightSegments,e.depthSegments)}};var ho=class i extends rt{constructor(e=1,t=32,n=0,s=Math.PI*2){super(),this.type="CircleGeometry",this.parameters={radius:e,segments:t,thetaStart:n,thetaLength:s},t=Math.max(3,t);let r=[],o=[],a=[],l=[],c=new C,h=new _e;o.push(0,0,0),a.push(0,0,1),l.push(.5,.5);for(let u=0,d=3;u<=t;u++,d+=3){let f=n+u/t*s;c.x=e*Math.cos(f),c.y=e*Math.sin(f),o.push(c.x,c.y,c.z),a.push(0,0,1),h.x=(o[d]/e+1)/2,h.y=(o[d+1]/e+1)/2,l.push(h.x,h.y)}for(let u=1;u<=t;u++)r.push(u,u+1,0);this.setIndex(r),this.setAttribute("position",new vt(o,3)),this.setAttribute("normal",new vt(a,3)),this.setAttribute("uv",new vt(l,2))}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new i(e.radius,e.segments,e.thetaStart,e.thetaLength)}};function cx(i,e,t=2){let n=e&&e.length,s=n?e[0]*t:i.length,r=Jp(i,0,s,t,!0),o=[];if(!r||r.next===r.prev)return o;let a,l,c;if(n&&(r=px(i,e,r,t)),i.length>80*t){a=i[0],l=i[1];let h=a,u=l;for(let d=t;d<s;d+=t){let f=i[d],p=i[d+1];f<a&&(a=f),p<l&&(l=p),f>h&&(h=f),p>u&&(u=p)}c=Math.max(h-a,u-l),c=c!==0?32767/c:0}return uo(r,o,t,a,l,c,0),o}function Jp(i,e,t,n,s){let r;if(s===Tx(i,e,t,n)>0)for(let o=e;o<t;o+=n)r=np(o/n|0,i[o],i[o+1],r);else for(let o=t-n;o>=e;o-=n)r=np(o/n|0,i[o],i[o+1],r);return r&&Qs(r,r.next)&&(po(r),r=r.next),r}function hs(i,e){if(!i)return i;e||(e=i);let t=i,n;do if(n=!1,!t.steiner&&(Qs(t,t.next)||Et(t.prev,t,t.next)===0)){if(po(t),t=e=t.prev,t===t.next)break;n=!0}else t=t.next;while(n||t!==e);return e}function uo(i,e,t,n,s,r,o){if(!i)return;!o&&r&&_x(i,n,s,r);let a=i;for(;i.prev!==i.next;){let l=i.prev,c=i.next;if(r?ux(i,n,s,r):hx(i)){e.push(l.i,i.i,c.i),po(i),i=c.next,a=c.next;continue}if(i=c,i===a){o?o===1?(i=dx(hs(i),e),uo(i,e,t,n,s,r,2)):o===2&&fx(i,e,t,n,s,r):uo(hs(i),e,t,n,s,r,1);break}}}function hx(i){let e=i.prev,t=i,n=i.next;if(Et(e,t,n)>=0)return!1;let s=e.x,r=t.x,o=n.x,a=e.y,l=t.y,c=n.y,h=Math.min(s,r,o),u=Math.min(a,l,c),d=Math.max(s,r,o),f=Math.max(a,l,c),p=n.next;for(;p!==e;){if(p.x>=h&&p.x<=d&&p.y>=u&&p.y<=f&&Wr(s,a,r,l,o,c,p.x,p.y)&&Et(p.prev,p,p.next)>=0)return!1;p=p.next}return!0}function ux(i,e,t,n){let s=i.prev,r=i,o=i.next;if(Et(s,r,o)>=0)return!1;let a=s.x,l=r.x,c=o.x,h=s.y,u=r.y,d=o.y,f=Math.min(a,l,c),p=Math.min(h,u,d),v=Math.max(a,l,c),m=Math.max(h,u,d),g=du(f,p,e,t,n),x=du(v,m,e,t,n),b=i.prevZ,_=i.nextZ;for(;b&&b.z>=g&&_&&_.z<=x;){if(b.x>=f&&b.x<=v&&b.y>=p&&b.y<=m&&b!==s&&b!==o&&Wr(a,h,l,u,c,d,b.x,b.y)&&Et(b.prev,b,b.next)>=0||(b=b.prevZ,_.x>=f&&_.x<=v&&_.y>=p&&_.y<=m&&_!==s&&_!==o&&Wr(a,h,l,u,c,d,_.x,_.y)&&Et(_.prev,_,_.next)>=0))return!1;_=_.nextZ}for(;b&&b.z>=g;){if(b.x>=f&&b.x<=v&&b.y>=p&&b.y<=m&&b!==s&&b!==o&&Wr(a,h,l,u,c,d,b.x,b.y)&&Et(b.prev,b,b.next)>=0)return!1;b=b.prevZ}for(;_&&_.z<=x;){if(_.x>=f&&_.x<=v&&_.y>=p&&_.y<=m&&_!==s&&_!==o&&Wr(a,h,l,u,c,d,_.x,_.y)&&Et(_.prev,_,_.next)>=0)return!1;_=_.nextZ}return!0}function dx(i,e){let t=i;do{let n=t.prev,s=t.next.next;!Qs(n,s)&&Qp(n,t,t.next,s)&&fo(n,s)&&fo(s,n)&&(e.push(n.i,t.i,s.i),po(t),po(t.next),t=i=s),t=t.next}while(t!==i);return hs(t)}function fx(i,e,t,n,s,r){let o=i;do{let a=o.next.next;for(;a!==o.prev;){if(o.i!==a.i&&Mx(o,a)){let l=em(o,a);o=hs(o,o.next),l=hs(l,l.next),uo(o,e,t,n,s,r,0),uo(l,e,t,n,s,r,0);return}a=a.next}o=o.next}while(o!==i)}function px(i,e,t,n){let s=[];for(let r=0,o=e.length;r<o;r++){let a=e[r]*n,l=r<o-1?e[r+1]*n:i.length,c=Jp(i,a,l,n,!1);c===c.next&&(c.steiner=!0),s.push(bx(c))}s.sort(mx);for(let r=0;r<s.length;r++)t=gx(s[r],t);return t}function mx(i,e){let t=i.x-e.x;if(t===0&&(t=i.y-e.y,t===0)){let n=(i.next.y-i.y)/(i.next.x-i.x),s=(e.next.y-e.y)/(e.next.x-e.x);t=n-s}return t}function gx(i,e){let t=yx(i,e);if(!t)return e;let n=em(t,i);return hs(n,n.next),hs(t,t.next)}function yx(i,e){let t=e,n=i.x,s=i.y,r=-1/0,o;if(Qs(i,t))return t;do{if(Qs(i,t.next))return t.next;if(s<=t.y&&s>=t.next.y&&t.next.y!==t.y){let u=t.x+(s-t.y)*(t.next.x-t.x)/(t.next.y-t.y);if(u<=n&&u>r&&(r=u,o=t.x<t.next.x?t:t.next,u===n))return o}t=t.next}while(t!==e);if(!o)return null;let a=o,l=o.x,c=o.y,h=1/0;t=o;do{if(n>=t.x&&t.x>=l&&n!==t.x&&Kp(s<c?n:r,s,l,c,s<c?r:n,s,t.x,t.y)){let u=Math.abs(s-t.y)/(n-t.x);fo(t,i)&&(u<h||u===h&&(t.x>o.x||t.x===o.x&&xx(o,t)))&&(o=t,h=u)}t=t.next}while(t!==a);return o}function xx(i,e){return Et(i.prev,i,e.prev)<0&&Et(e.next,i,i.next)<0}function _x(i,e,t,n){let s=i;do s.z===0&&(s.z=du(s.x,s.y,e,t,n)),s.prevZ=s.prev,s.nextZ=s.next,s=s.next;while(s!==i);s.prevZ.nextZ=null,s.prevZ=null,vx(s)}function vx(i){let e,t=1;do{let n=i,s;i=null;let r=null;for(e=0;n;){e++;let o=n,a=0;for(let c=0;c<t&&(a++,o=o.nextZ,!!o);c++);let l=t;for(;a>0||l>0&&o;)a!==0&&(l===0||!o||n.z<=o.z)?(s=n,n=n.nextZ,a--):(s=o,o=o.nextZ,l--),r?r.nextZ=s:i=s,s.prevZ=r,r=s;n=o}r.nextZ=null,t*=2}while(e>1);return i}function du(i,e,t,n,s){return i=(i-t)*s|0,e=(e-n)*s|0,i=(i|i<<8)&16711935,i=(i|i<<4)&252645135,i=(i|i<<2)&858993459,i=(i|i<<1)&1431655765,e=(e|e<<8)&16711935,e=(e|e<<4)&252645135,e=(e|e<<2)&858993459,e=(e|e<<1)&1431655765,i|e<<1}function bx(i){let e=i,t=i;do(e.x<t.x||e.x===t.x&&e.y<t.y)&&(t=e),e=e.next;while(e!==i);return t}function Kp(i,e,t,n,s,r,o,a){return(s-o)*(e-a)>=(i-o)*(r-a)&&(i-o)*(n-a)>=(t-o)*(e-a)&&(t-o)*(r-a)>=(s-o)*(n-a)}function Wr(i,e,t,n,s,r,o,a){return!(i===o&&e===a)&&Kp(i,e,t,n,s,r,o,a)}function Mx(i,e){return i.next.i!==e.i&&i.prev.i!==e.i&&!Sx(i,e)&&(fo(i,e)&&fo(e,i)&&wx(i,e)&&(Et(i.prev,i,e.prev)||Et(i,e.prev,e))||Qs(i,e)&&Et(i.prev,i,i.next)>0&&Et(e.prev,e,e.next)>0)}function Et(i,e,t){return(e.y-i.y)*(t.x-e.x)-(e.x-i.x)*(t.y-e.y)}function Qs(i,e){return i.x===e.x&&i.y===e.y}function Qp(i,e,t,n){let s=Ra(Et(i,e,t)),r=Ra(Et(i,e,n)),o=Ra(Et(t,n,i)),a=Ra(Et(t,n,e));return!!(s!==r&&o!==a||s===0&&Ca(i,t,e)||r===0&&Ca(i,n,e)||o===0&&Ca(t,i,n)||a===0&&Ca(t,e,n))}function Ca(i,e,t){return e.x<=Math.max(i.x,t.x)&&e.x>=Math.min(i.x,t.x)&&e.y<=Math.max(i.y,t.y)&&e.y>=Math.min(i.y,t.y)}function Ra(i){return i>0?1:i<0?-1:0}function Sx(i,e){let t=i;do{if(t.i!==i.i&&t.next.i!==i.i&&t.i!==e.i&&t.next.i!==e.i&&Qp(t,t.next,i,e))return!0;t=t.next}while(t!==i);return!1}function fo(i,e){return Et(i.prev,i,i.next)<0?Et(i,e,i.next)>=0&&Et(i,i.prev,e)>=0:Et(i,e,i.prev)<0||Et(i,i.next,e)<0}function wx(i,e){let t=i,n=!1,s=(i.x+e.x)/2,r=(i.y+e.y)/2;do t.y>r!=t.next.y>r&&t.next.y!==t.y&&s<(t.next.x-t.x)*(r-t.y)/(t.next.y-t.y)+t.x&&(n=!n),t=t.next;while(t!==i);return n}function em(i,e){let t=fu(i.i,i.x,i.y),n=fu(e.i,e.x,e.y),s=i.next,r=e.prev;return i.next=e,e.prev=i,t.next=s,s.prev=t,n.next=t,t.prev=n,r.next=n,n.prev=r,n}function np(i,e,t,n){let s=fu(i,e,t);return n?(s.next=n.next,s.prev=n,n.next.prev=s,n.next=s):(s.prev=s,s.next=s),s}function po(i){i.next.prev=i.prev,i.prev.next=i.next,i.prevZ&&(i.prevZ.nextZ=i.nextZ),i.nextZ&&(i.nextZ.prevZ=i.prevZ)}function fu(i,e,t){return{i,x:e,y:t,prev:null,next:null,z:0,prevZ:null,nextZ:null,steiner:!1}}function Tx(i,e,t,n){let s=0;for(let r=e,o=t-n;r<t;r+=n)s+=(i[o]-i[r])*(i[r+1]+i[o+1]),o=r;return s}var pu=class{static triangulate(e,t,n=2){return cx(e,t,n)}},er=class i{static area(e){let t=e.length,n=0;for(let s=t-1,r=0;r<t;s=r++)n+=e[s].x*e[r].y-e[r].x*e[s].y;return n*.5}static isClockWise(e){return i.area(e)<0}static triangulateShape(e,t){let n=[],s=[],r=[];ip(e),sp(n,e);let o=e.length;t.forEach(ip);for(let l=0;l<t.length;l++)s.push(o),o+=t[l].length,sp(n,t[l]);let a=pu.triangulate(n,s);for(let l=0;l<a.length;l+=3)r.push(a.slice(l,l+3));return r}};function ip(i){let e=i.length;e>2&&i[e-1].equals(i[0])&&i.pop()}function sp(i,e){for(let t=0;t<e.length;t++)i.push(e[t].x),i.push(e[t].y)}var In=class i extends rt{constructor(e=1,t=1,n=1,s=1){super(),this.type="PlaneGeometry",this.parameters={width:e,height:t,widthSegments:n,heightSegments:s};let r=e/2,o=t/2,a=Math.floor(n),l=Math.floor(s),c=a+1,h=l+1,u=e/a,d=t/l,f=[],p=[],v=[],m=[];for(let g=0;g<h;g++){let x=g*d-o;for(let b=0;b<c;b++){let _=b*u-r;p.push(_,-x,0),v.push(0,0,1),m.push(b/a),m.push(1-g/l)}}for(let g=0;g<l;g++)for(let x=0;x<a;x++){let b=x+c*g,_=x+c*(g+1),M=x+1+c*(g+1),A=x+1+c*g;f.push(b,_,A),f.push(_,M,A)}this.setIndex(f),this.setAttribute("position",new vt(p,3)),this.setAttribute("normal",new vt(v,3)),this.setAttribute("uv",new vt(m,2))}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new i(e.width,e.height,e.widthSegments,e.heightSegments)}},mo=class i extends rt{constructor(e=.5,t=1,n=32,s=1,r=0,o=Math.PI*2){super(),this.type="RingGeometry",this.parameters={innerRadius:e,outerRadius:t,thetaSegments:n,phiSegments:s,thetaStart:r,thetaLength:o},n=Math.max(3,n),s=Math.max(1,s);let a=[],l=[],c=[],h=[],u=e,d=(t-e)/s,f=new C,p=new _e;for(let v=0;v<=s;v++){for(let m=0;m<=n;m++){let g=r+m/n*o;f.x=u*Math.cos(g),f.y=u*Math.sin(g),l.push(f.x,f.y,f.z),c.push(0,0,1),p.x=(f.x/t+1)/2,p.y=(f.y/t+1)/2,h.push(p.x,p.y)}u+=d}for(let v=0;v<s;v++){let m=v*(n+1);for(let g=0;g<n;g++){let x=g+m,b=x,_=x+n+1,M=x+n+2,A=x+1;a.push(b,_,A),a.push(_,M,A)}}this.setIndex(a),this.setAttribute("position",new vt(l,3)),this.setAttribute("normal",new vt(c,3)),this.setAttribute("uv",new vt(h,2))}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new i(e.innerRadius,e.outerRadius,e.thetaSegments,e.phiSegments,e.thetaStart,e.thetaLength)}};var us=class i extends rt{constructor(e=1,t=32,n=16,s=0,r=Math.PI*2,o=0,a=Math.PI){super(),this.type="SphereGeometry",this.parameters={radius:e,widthSegments:t,heightSegments:n,phiStart:s,phiLength:r,thetaStart:o,thetaLength:a},t=Math.max(3,Math.floor(t)),n=Math.max(2,Math.floor(n));let l=Math.min(o+a,Math.PI),c=0,h=[],u=new C,d=new C,f=[],p=[],v=[],m=[];for(let g=0;g<=n;g++){let x=[],b=g/n,_=o+b*a,M=e*Math.cos(_),A=Math.sqrt(e*e-M*M),y=0;g===0&&o===0?y=.5/t:g===n&&l===Math.PI&&(y=-.5/t);for(let S=0;S<=t;S++){let N=S/t,E=s+N*r;u.x=-A*Math.cos(E),u.y=M,u.z=A*Math.sin(E),p.push(u.x,u.y,u.z),d.copy(u).normalize(),v.push(d.x,d.y,d.z),m.push(N+y,1-b),x.push(c++)}h.push(x)}for(let g=0;g<n;g++)for(let x=0;x<t;x++){let b=h[g][x+1],_=h[g][x],M=h[g+1][x],A=h[g+1][x+1];(g!==0||o>0)&&f.push(b,_,A),(g!==n-1||l<Math.PI)&&f.push(_,M,A)}this.setIndex(f),this.setAttribute("position",new vt(p,3)),this.setAttribute("normal",new vt(v,3)),this.setAttribute("uv",new vt(m,2))}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new i(e.radius,e.widthSegments,e.heightSegments,e.phiStart,e.phiLength,e.thetaStart,e.thetaLength)}};function gs(i){let e={};for(let t in i){e[t]={};for(let n in i[t]){let s=i[t][n];if(rp(s))s.isRenderTargetTexture?(Re("UniformsUtils: Textures of render targets cannot be cloned via cloneUniforms() or mergeUniforms()."),e[t][n]=null):e[t][n]=s.clone();else if(Array.isArray(s))if(rp(s[0])){let r=[];for(let o=0,a=s.length;o<a;o++)r[o]=s[o].clone();e[t][n]=r}else e[t][n]=s.slice();else e[t][n]=s}}return e}function an(i){let e={};for(let t=0;t<i.length;t++){let n=gs(i[t]);for(let s in n)e[s]=n[s]}return e}function rp(i){return i&&(i.isColor||i.isMatrix3||i.isMatrix4||i.isVector2||i.isVector3||i.isVector4||i.isTexture||i.isQuaternion)}function Ax(i){let e=[];for(let t=0;t<i.length;t++)e.push(i[t].clone());return e}function Zu(i){let e=i.getRenderTarget();return e===null?i.outputColorSpace:e.isXRRenderTarget===!0?e.texture.colorSpace:$e.workingColorSpace}var tm={clone:gs,merge:an},Ex=`void main() {
	gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
}`,Cx=`void main() {
	gl_FragColor = vec4( 1.0, 0.0, 0.0, 1.0 );
}`,on=class extends ci{constructor(e){super(),this.isShaderMaterial=!0,this.type="ShaderMaterial",this.defines={},this.uniforms={},this.uniformsGroups=[],this.vertexShader=Ex,this.fragmentShader=Cx,this.linewidth=1,this.wireframe=!1,this.wireframeLinewidth=1,this.fog=!1,this.lights=!1,this.clipping=!1,this.forceSinglePass=!0,this.extensions={clipCullDistance:!1,multiDraw:!1},this.defaultAttributeValues={color:[1,1,1],uv:[0,0],uv1:[0,0]},this.index0AttributeName=void 0,this.uniformsNeedUpdate=!1,this.glslVersion=null,e!==void 0&&this.setValues(e)}copy(e){return super.copy(e),this.fragmentShader=e.fragmentShader,this.vertexShader=e.vertexShader,this.uniforms=gs(e.uniforms),this.uniformsGroups=Ax(e.uniformsGroups),this.defines=Object.assign({},e.defines),this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this.fog=e.fog,this.lights=e.lights,this.clipping=e.clipping,this.extensions=Object.assign({},e.extensions),this.glslVersion=e.glslVersion,this.defaultAttributeValues=Object.assign({},e.defaultAttributeValues),this.index0AttributeName=e.index0AttributeName,this.uniformsNeedUpdate=e.uniformsNeedUpdate,this}toJSON(e){let t=super.toJSON(e);t.glslVersion=this.glslVersion,t.uniforms={};for(let s in this.uniforms){let o=this.uniforms[s].value;o&&o.isTexture?t.uniforms[s]={type:"t",value:o.toJSON(e).uuid}:o&&o.isColor?t.uniforms[s]={type:"c",value:o.getHex()}:o&&o.isVector2?t.uniforms[s]={type:"v2",value:o.toArray()}:o&&o.isVector3?t.uniforms[s]={type:"v3",value:o.toArray()}:o&&o.isVector4?t.uniforms[s]={type:"v4",value:o.toArray()}:o&&o.isMatrix3?t.uniforms[s]={type:"m3",value:o.toArray()}:o&&o.isMatrix4?t.uniforms[s]={type:"m4",value:o.toArray()}:t.uniforms[s]={value:o}}Object.keys(this.defines).length>0&&(t.defines=this.defines),t.vertexShader=this.vertexShader,t.fragmentShader=this.fragmentShader,t.lights=this.lights,t.clipping=this.clipping;let n={};for(let s in this.extensions)this.extensions[s]===!0&&(n[s]=!0);return Object.keys(n).length>0&&(t.extensions=n),t}fromJSON(e,t){if(super.fromJSON(e,t),e.uniforms!==void 0)for(let n in e.uniforms){let s=e.uniforms[n];switch(this.uniforms[n]={},s.type){case"t":this.uniforms[n].value=t[s.value]||null;break;case"c":this.uniforms[n].value=new De().setHex(s.value);break;case"v2":this.uniforms[n].value=new _e().fromArray(s.value);break;case"v3":this.uniforms[n].value=new C().fromArray(s.value);break;case"v4":this.uniforms[n].value=new Ct().fromArray(s.value);break;case"m3":this.uniforms[n].value=new Ue().fromArray(s.value);break;case"m4":this.uniforms[n].value=new Le().fromArray(s.value);break;default:this.uniforms[n].value=s.value}}if(e.defines!==void 0&&(this.defines=e.defines),e.vertexShader!==void 0&&(this.vertexShader=e.vertexShader),e.fragmentShader!==void 0&&(this.fragmentShader=e.fragmentShader),e.glslVersion!==void 0&&(this.glslVersion=e.glslVersion),e.extensions!==void 0)for(let n in e.extensions)this.extensions[n]=e.extensions[n];return e.lights!==void 0&&(this.lights=e.lights),e.clipping!==void 0&&(this.clipping=e.clipping),this}},Qa=class extends on{constructor(e){super(e),this.isRawShaderMaterial=!0,this.type="RawShaderMaterial"}};var el=class extends ci{constructor(e){super(),this.isMeshDepthMaterial=!0,this.type="MeshDepthMaterial",this.depthPacking=Fp,this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.wireframe=!1,this.wireframeLinewidth=1,this.setValues(e)}copy(e){return super.copy(e),this.depthPacking=e.depthPacking,this.map=e.map,this.alphaMap=e.alphaMap,this.displacementMap=e.displacementMap,this.displacementScale=e.displacementScale,this.displacementBias=e.displacementBias,this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this}},tl=class extends ci{constructor(e){super(),this.isMeshDistanceMaterial=!0,this.type="MeshDistanceMaterial",this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.setValues(e)}copy(e){return super.copy(e),this.map=e.map,this.alphaMap=e.alphaMap,this.displacementMap=e.displacementMap,this.displacementScale=e.displacementScale,this.displacementBias=e.displacementBias,this}};function Us(i,e){return!i||i.constructor===e?i:typeof e.BYTES_PER_ELEMENT=="number"?new e(i):Array.prototype.slice.call(i)}function Pa(i){return i!==void 0&&i.inTangents!==void 0&&i.outTangents!==void 0}var Gi=class{constructor(e,t,n,s){this.parameterPositions=e,this._cachedIndex=0,this.resultBuffer=s!==void 0?s:new t.constructor(n),this.sampleValues=t,this.valueSize=n,this.settings=null,this.DefaultSettings_={}}evaluate(e){let t=this.parameterPositions,n=this._cachedIndex,s=t[n],r=t[n-1];n:{e:{let o;t:{i:if(!(e<s)){for(let a=n+2;;){if(s===void 0){if(e<r)break i;return n=t.length,this._cachedIndex=n,this.copySampleValue_(n-1)}if(n===a)break;if(r=s,s=t[++n],e<s)break e}o=t.length;break t}if(!(e>=r)){let a=t[1];e<a&&(n=2,r=a);for(let l=n-2;;){if(r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(n===l)break;if(s=r,r=t[--n-1],e>=r)break e}o=n,n=0;break t}break n}for(;n<o;){let a=n+o>>>1;e<t[a]?o=a:n=a+1}if(s=t[n],r=t[n-1],r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(s===void 0)return n=t.length,this._cachedIndex=n,this.copySampleValue_(n-1)}this._cachedIndex=n,this.intervalChanged_(n,r,s)}return this.interpolate_(n,r,e,s)}getSettings_(){return this.settings||this.DefaultSettings_}copySampleValue_(e){let t=this.resultBuffer,n=this.sampleValues,s=this.valueSize,r=e*s;for(let o=0;o!==s;++o)t[o]=n[r+o];return t}interpolate_(){throw new Error("THREE.Interpolant: Call to abstract method.")}intervalChanged_(){}},nl=class extends Gi{constructor(e,t,n,s){super(e,t,n,s),this._weightPrev=-0,this._offsetPrev=-0,this._weightNext=-0,this._offsetNext=-0,this.DefaultSettings_={endingStart:au,endingEnd:au}}intervalChanged_(e,t,n){let s=this.parameterPositions,r=e-2,o=e+1,a=s[r],l=s[o];if(a===void 0)switch(this.getSettings_().endingStart){case lu:r=e,a=2*t-n;break;case cu:r=s.length-2,a=t+s[r]-s[r+1];break;default:r=e,a=n}if(l===void 0)switch(this.getSettings_().endingEnd){case lu:o=e,l=2*n-t;break;case cu:o=1,l=n+s[1]-s[0];break;default:o=e-1,l=t}let c=(n-t)*.5,h=this.valueSize;this._weightPrev=c/(t-a),this._weightNext=c/(l-n),this._offsetPrev=r*h,this._offsetNext=o*h}interpolate_(e,t,n,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=e*a,c=l-a,h=this._offsetPrev,u=this._offsetNext,d=this._weightPrev,f=this._weightNext,p=(n-t)/(s-t),v=p*p,m=v*p,g=-d*m+2*d*v-d*p,x=(1+d)*m+(-1.5-2*d)*v+(-.5+d)*p+1,b=(-1-f)*m+(1.5+f)*v+.5*p,_=f*m-f*v;for(let M=0;M!==a;++M)r[M]=g*o[h+M]+x*o[c+M]+b*o[l+M]+_*o[u+M];return r}},il=class extends Gi{constructor(e,t,n,s){super(e,t,n,s)}interpolate_(e,t,n,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=e*a,c=l-a,h=(n-t)/(s-t),u=1-h;for(let d=0;d!==a;++d)r[d]=o[c+d]*u+o[l+d]*h;return r}},sl=class extends Gi{constructor(e,t,n,s){super(e,t,n,s)}interpolate_(e){return this.copySampleValue_(e-1)}},rl=class extends Gi{interpolate_(e,t,n,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=e*a,c=l-a,h=this.inTangents,u=this.outTangents;if(!h||!u){let p=(n-t)/(s-t),v=1-p;for(let m=0;m!==a;++m)r[m]=o[c+m]*v+o[l+m]*p;return r}let d=a*2,f=e-1;for(let p=0;p!==a;++p){let v=o[c+p],m=o[l+p],g=f*d+p*2,x=u[g],b=u[g+1],_=e*d+p*2,M=h[_],A=h[_+1],y=Px(n,t,x,M,s);r[p]=nm(y,v,b,A,m)}return r}};function nm(i,e,t,n,s){let r=1-i;return r*r*r*e+3*r*r*i*t+3*r*i*i*n+i*i*i*s}function Rx(i,e,t,n,s){let r=1-i;return 3*r*r*(t-e)+6*r*i*(n-t)+3*i*i*(s-n)}function Px(i,e,t,n,s){let r=(i-e)/(s-e);for(let o=0;o<8;o++){let a=nm(r,e,t,n,s)-i;if(Math.abs(a)<1e-10)break;let l=Rx(r,e,t,n,s);if(Math.abs(l)<1e-10)break;r=Math.max(0,Math.min(1,r-a/l))}return r}var Ln=class{constructor(e,t,n,s){if(e===void 0)throw new Error("THREE.KeyframeTrack: track name is undefined");if(t===void 0||t.length===0)throw new Error("THREE.KeyframeTrack: no keyframes in track named "+e);this.name=e,this.times=Us(t,this.TimeBufferType),this.values=Us(n,this.ValueBufferType),this.setInterpolation(s||this.DefaultInterpolation)}static toJSON(e){let t=e.constructor,n;if(t.toJSON!==this.toJSON)n=t.toJSON(e);else{n={name:e.name,times:Us(e.times,Array),values:Us(e.values,Array)};let s=e.getInterpolation();s!==e.DefaultInterpolation&&(n.interpolation=s),Pa(e.settings)&&(n.settings={inTangents:Us(e.settings.inTangents,Array),outTangents:Us(e.settings.outTangents,Array)})}return n.type=e.ValueTypeName,n}InterpolantFactoryMethodDiscrete(e){return new sl(this.times,this.values,this.getValueSize(),e)}InterpolantFactoryMethodLinear(e){return new il(this.times,this.values,this.getValueSize(),e)}InterpolantFactoryMethodSmooth(e){return new nl(this.times,this.values,this.getValueSize(),e)}InterpolantFactoryMethodBezier(e){let t=new rl(this.times,this.values,this.getValueSize(),e);return this.settings&&(t.inTangents=this.settings.inTangents,t.outTangents=this.settings.outTangents),t}setInterpolation(e){let t;switch(e){case Yr:t=this.InterpolantFactoryMethodDiscrete;break;case Xa:t=this.InterpolantFactoryMethodLinear;break;case Da:t=this.InterpolantFactoryMethodSmooth;break;case ou:t=this.InterpolantFactoryMethodBezier;break}if(t===void 0){let n="unsupported interpolation for "+this.ValueTypeName+" keyframe track named "+this.name;if(this.createInterpolant===void 0)if(e!==this.DefaultInterpolation)this.setInterpolation(this.DefaultInterpolation);else throw new Error(n);return Re("KeyframeTrack:",n),this}return this.createInterpolant=t,this}getInterpolation(){switch(this.createInterpolant){case this.InterpolantFactoryMethodDiscrete:return Yr;case this.InterpolantFactoryMethodLinear:return Xa;case this.InterpolantFactoryMethodSmooth:return Da;case this.InterpolantFactoryMethodBezier:return ou}}getValueSize(){return this.values.length/this.times.length}shift(e){if(e!==0){let t=this.times;for(let n=0,s=t.length;n!==s;++n)t[n]+=e;Pa(this.settings)&&(op(this.settings.inTangents,e),op(this.settings.outTangents,e))}return this}scale(e){if(e!==1){let t=this.times;for(let n=0,s=t.length;n!==s;++n)t[n]*=e;Pa(this.settings)&&(ap(this.settings.inTangents,e),ap(this.settings.outTangents,e))}return this}trim(e,t){let n=this.times,s=n.length,r=0,o=s-1;for(;r!==s&&n[r]<e;)++r;for(;o!==-1&&n[o]>t;)--o;if(++o,r!==0||o!==s){r>=o&&(o=Math.max(o,1),r=o-1);let a=this.getValueSize();this.times=n.slice(r,o),this.values=this.values.slice(r*a,o*a)}return this}validate(){let e=!0,t=this.getValueSize();t-Math.floor(t)!==0&&(Ne("KeyframeTrack: Invalid value size in track.",this),e=!1);let n=this.times,s=this.values,r=n.length;r===0&&(Ne("KeyframeTrack: Track is empty.",this),e=!1);let o=null;for(let a=0;a!==r;a++){let l=n[a];if(typeof l=="number"&&isNaN(l)){Ne("KeyframeTrack: Time is not a valid number.",this,a,l),e=!1;break}if(o!==null&&o>l){Ne("KeyframeTrack: Out of order keys.",this,a,l,o),e=!1;break}o=l}if(s!==void 0&&My(s))for(let a=0,l=s.length;a!==l;++a){let c=s[a];if(isNaN(c)){Ne("KeyframeTrack: Value is not a valid number.",this,a,c),e=!1;break}}return e}optimize(){let e=this.times.slice(),t=this.values.slice(),n=this.getValueSize(),s=this.getInterpolation()===Da,r=e.length-1,o=1;for(let a=1;a<r;++a){let l=!1,c=e[a],h=e[a+1];if(c!==h&&(a!==1||c!==e[0]))if(s)l=!0;else{let u=a*n,d=u-n,f=u+n;for(let p=0;p!==n;++p){let v=t[u+p];if(v!==t[d+p]||v!==t[f+p]){l=!0;break}}}if(l){if(a!==o){e[o]=e[a];let u=a*n,d=o*n;for(let f=0;f!==n;++f)t[d+f]=t[u+f]}++o}}if(r>0){e[o]=e[r];for(let a=r*n,l=o*n,c=0;c!==n;++c)t[l+c]=t[a+c];++o}return o!==e.length?(this.times=e.slice(0,o),this.values=t.slice(0,o*n)):(this.times=e,this.values=t),this}clone(){let e=this.times.slice(),t=this.values.slice(),n=this.constructor,s=new n(this.name,e,t);return s.createInterpolant=this.createInterpolant,Pa(this.settings)&&(s.settings={inTangents:this.settings.inTangents.slice(),outTangents:this.settings.outTangents.slice()}),s}};function op(i,e){for(let t=0,n=i.length;t!==n;t+=2)i[t]+=e}function ap(i,e){for(let t=0,n=i.length;t!==n;t+=2)i[t]*=e}Ln.prototype.ValueTypeName="";Ln.prototype.TimeBufferType=Float32Array;Ln.prototype.ValueBufferType=Float32Array;Ln.prototype.DefaultInterpolation=Xa;var Hi=class extends Ln{constructor(e,t,n){super(e,t,n)}};Hi.prototype.ValueTypeName="bool";Hi.prototype.ValueBufferType=Array;Hi.prototype.DefaultInterpolation=Yr;Hi.prototype.InterpolantFactoryMethodLinear=void 0;Hi.prototype.InterpolantFactoryMethodSmooth=void 0;var ol=class extends Ln{constructor(e,t,n,s){super(e,t,n,s)}};ol.prototype.ValueTypeName="color";var al=class extends Ln{constructor(e,t,n,s){super(e,t,n,s)}};al.prototype.ValueTypeName="number";var ll=class extends Gi{constructor(e,t,n,s){super(e,t,n,s)}interpolate_(e,t,n,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=(n-t)/(s-t),c=e*a;for(let h=c+a;c!==h;c+=4)jt.slerpFlat(r,0,o,c-a,o,c,l);return r}},go=class extends Ln{constructor(e,t,n,s){super(e,t,n,s)}InterpolantFactoryMethodLinear(e){return new ll(this.times,this.values,this.getValueSize(),e)}};go.prototype.ValueTypeName="quaternion";go.prototype.InterpolantFactoryMethodSmooth=void 0;var Wi=class extends Ln{constructor(e,t,n){super(e,t,n)}};Wi.prototype.ValueTypeName="string";Wi.prototype.ValueBufferType=Array;Wi.prototype.DefaultInterpolation=Yr;Wi.prototype.InterpolantFactoryMethodLinear=void 0;Wi.prototype.InterpolantFactoryMethodSmooth=void 0;var cl=class extends Ln{constructor(e,t,n,s){super(e,t,n,s)}};cl.prototype.ValueTypeName="vector";var hl=class{constructor(e,t,n){let s=this,r=!1,o=0,a=0,l,c=[];this.onStart=void 0,this.onLoad=e,this.onProgress=t,this.onError=n,this._abortController=null,this.itemStart=function(h){a++,r===!1&&s.onStart!==void 0&&s.onStart(h,o,a),r=!0},this.itemEnd=function(h){o++,s.onProgress!==void 0&&s.onProgress(h,o,a),o===a&&(r=!1,s.onLoad!==void 0&&s.onLoad())},this.itemError=function(h){s.onError!==void 0&&s.onError(h)},this.resolveURL=function(h){return h=h.normalize("NFC"),l?l(h):h},this.setURLModifier=function(h){return l=h,this},this.addHandler=function(h,u){return c.push(h,u),this},this.removeHandler=function(h){let u=c.indexOf(h);return u!==-1&&c.splice(u,2),this},this.getHandler=function(h){for(let u=0,d=c.length;u<d;u+=2){let f=c[u],p=c[u+1];if(f.global&&(f.lastIndex=0),f.test(h))return p}return null},this.abort=function(){return this.abortController.abort(),this._abortController=null,this}}get abortController(){return this._abortController||(this._abortController=new AbortController),this._abortController}},im=new hl,ul=class{constructor(e){this.manager=e!==void 0?e:im,this.crossOrigin="anonymous",this.withCredentials=!1,this.path="",this.resourcePath="",this.requestHeader={},this.priority="auto",this.cache="default",typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}load(){}loadAsync(e,t){let n=this;return new Promise(function(s,r){n.load(e,s,t,r)})}parse(){}setCrossOrigin(e){return this.crossOrigin=e,this}setWithCredentials(e){return this.withCredentials=e,this}setPath(e){return this.path=e,this}setResourcePath(e){return this.resourcePath=e,this}setRequestHeader(e){return this.requestHeader=e,this}setPriority(e){return this.priority=e,this}setCache(e){return this.cache=e,this}abort(){return this}};ul.DEFAULT_MATERIAL_NAME="__DEFAULT";var Ia=new C,La=new jt,oi=new C,yo=class extends yn{constructor(){super(),this.isCamera=!0,this.type="Camera",this.matrixWorldInverse=new Le,this.projectionMatrix=new Le,this.projectionMatrixInverse=new Le,this.coordinateSystem=Gn,this._reversedDepth=!1}get reversedDepth(){return this._reversedDepth}copy(e,t){return super.copy(e,t),this.matrixWorldInverse.copy(e.matrixWorldInverse),this.projectionMatrix.copy(e.projectionMatrix),this.projectionMatrixInverse.copy(e.projectionMatrixInverse),this.coordinateSystem=e.coordinateSystem,this}getWorldDirection(e){return super.getWorldDirection(e).negate()}updateMatrixWorld(e){super.updateMatrixWorld(e),this.matrixWorld.decompose(Ia,La,oi),oi.x===1&&oi.y===1&&oi.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(Ia,La,oi.set(1,1,1)).invert()}updateWorldMatrix(e,t,n=!1){super.updateWorldMatrix(e,t,n),this.matrixWorld.decompose(Ia,La,oi),oi.x===1&&oi.y===1&&oi.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(Ia,La,oi.set(1,1,1)).invert()}clone(){return new this.constructor().copy(this)}},Bi=new C,lp=new _e,cp=new _e,fn=class extends yo{constructor(e=50,t=1,n=.1,s=2e3){super(),this.isPerspectiveCamera=!0,this.type="PerspectiveCamera",this.fov=e,this.zoom=1,this.near=n,this.far=s,this.focus=10,this.aspect=t,this.view=null,this.filmGauge=35,this.filmOffset=0,this.updateProjectionMatrix()}copy(e,t){return super.copy(e,t),this.fov=e.fov,this.zoom=e.zoom,this.near=e.near,this.far=e.far,this.focus=e.focus,this.aspect=e.aspect,this.view=e.view===null?null:Object.assign({},e.view),this.filmGauge=e.filmGauge,this.filmOffset=e.filmOffset,this}setFocalLength(e){let t=.5*this.getFilmHeight()/e;this.fov=Ws*2*Math.atan(t),this.updateProjectionMatrix()}getFocalLength(){let e=Math.tan(qr*.5*this.fov);return .5*this.getFilmHeight()/e}getEffectiveFOV(){return Ws*2*Math.atan(Math.tan(qr*.5*this.fov)/this.zoom)}getFilmWidth(){return this.filmGauge*Math.min(this.aspect,1)}getFilmHeight(){return this.filmGauge/Math.max(this.aspect,1)}getViewBounds(e,t,n){Bi.set(-1,-1,.5).applyMatrix4(this.projectionMatrixInverse),t.set(Bi.x,Bi.y).multiplyScalar(-e/Bi.z),Bi.set(1,1,.5).applyMatrix4(this.projectionMatrixInverse),n.set(Bi.x,Bi.y).multiplyScalar(-e/Bi.z)}getViewSize(e,t){return this.getViewBounds(e,lp,cp),t.subVectors(cp,lp)}setViewOffset(e,t,n,s,r,o){this.aspect=e/t,this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=e,this.view.fullHeight=t,this.view.offsetX=n,this.view.offsetY=s,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let e=this.near,t=e*Math.tan(qr*.5*this.fov)/this.zoom,n=2*t,s=this.aspect*n,r=-.5*s,o=this.view;if(this.view!==null&&this.view.enabled){let l=o.fullWidth,c=o.fullHeight;r+=o.offsetX*s/l,t-=o.offsetY*n/c,s*=o.width/l,n*=o.height/c}let a=this.filmOffset;a!==0&&(r+=e*a/this.getFilmWidth()),this.projectionMatrix.makePerspective(r,r+s,t,t-n,e,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(e){let t=super.toJSON(e);return t.object.fov=this.fov,t.object.zoom=this.zoom,t.object.near=this.near,t.object.far=this.far,t.object.focus=this.focus,t.object.aspect=this.aspect,this.view!==null&&(t.object.view=Object.assign({},this.view)),t.object.filmGauge=this.filmGauge,t.object.filmOffset=this.filmOffset,t}};var tr=class extends yo{constructor(e=-1,t=1,n=1,s=-1,r=.1,o=2e3){super(),this.isOrthographicCamera=!0,this.type="OrthographicCamera",this.zoom=1,this.view=null,this.left=e,this.right=t,this.top=n,this.bottom=s,this.near=r,this.far=o,this.updateProjectionMatrix()}copy(e,t){return super.copy(e,t),this.left=e.left,this.right=e.right,this.top=e.top,this.bottom=e.bottom,this.near=e.near,this.far=e.far,this.zoom=e.zoom,this.view=e.view===null?null:Object.assign({},e.view),this}setViewOffset(e,t,n,s,r,o){this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=e,this.view.fullHeight=t,this.view.offsetX=n,this.view.offsetY=s,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let e=(this.right-this.left)/(2*this.zoom),t=(this.top-this.bottom)/(2*this.zoom),n=(this.right+this.left)/2,s=(this.top+this.bottom)/2,r=n-e,o=n+e,a=s+t,l=s-t;if(this.view!==null&&this.view.enabled){let c=(this.right-this.left)/this.view.fullWidth/this.zoom,h=(this.top-this.bottom)/this.view.fullHeight/this.zoom;r+=c*this.view.offsetX,o=r+c*this.view.width,a-=h*this.view.offsetY,l=a-h*this.view.height}this.projectionMatrix.makeOrthographic(r,o,a,l,this.near,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(e){let t=super.toJSON(e);return t.object.zoom=this.zoom,t.object.left=this.left,t.object.right=this.right,t.object.top=this.top,t.object.bottom=this.bottom,t.object.near=this.near,t.object.far=this.far,this.view!==null&&(t.object.view=Object.assign({},this.view)),t}};var Fs=-90,Bs=1,nr=class extends yn{constructor(e,t,n){super(),this.type="CubeCamera",this.renderTarget=n,this.coordinateSystem=null,this.activeMipmapLevel=0;let s=new fn(Fs,Bs,e,t);s.layers=this.layers,this.add(s);let r=new fn(Fs,Bs,e,t);r.layers=this.layers,this.add(r);let o=new fn(Fs,Bs,e,t);o.layers=this.layers,this.add(o);let a=new fn(Fs,Bs,e,t);a.layers=this.layers,this.add(a);let l=new fn(Fs,Bs,e,t);l.layers=this.layers,this.add(l);let c=new fn(Fs,Bs,e,t);c.layers=this.layers,this.add(c)}updateCoordinateSystem(){let e=this.coordinateSystem,t=this.children.concat(),[n,s,r,o,a,l]=t;for(let c of t)this.remove(c);if(e===Gn)n.up.set(0,1,0),n.lookAt(1,0,0),s.up.set(0,1,0),s.lookAt(-1,0,0),r.up.set(0,0,-1),r.lookAt(0,1,0),o.up.set(0,0,1),o.lookAt(0,-1,0),a.up.set(0,1,0),a.lookAt(0,0,1),l.up.set(0,1,0),l.lookAt(0,0,-1);else if(e===Jr)n.up.set(0,-1,0),n.lookAt(-1,0,0),s.up.set(0,-1,0),s.lookAt(1,0,0),r.up.set(0,0,1),r.lookAt(0,1,0),o.up.set(0,0,-1),o.lookAt(0,-1,0),a.up.set(0,-1,0),a.lookAt(0,0,1),l.up.set(0,-1,0),l.lookAt(0,0,-1);else throw new Error("THREE.CubeCamera.updateCoordinateSystem(): Invalid coordinate system: "+e);for(let c of t)this.add(c),c.updateMatrixWorld()}update(e,t){this.parent===null&&this.updateMatrixWorld();let{renderTarget:n,activeMipmapLevel:s}=this;this.coordinateSystem!==e.coordinateSystem&&(this.coordinateSystem=e.coordinateSystem,this.updateCoordinateSystem());let[r,o,a,l,c,h]=this.children,u=e.getRenderTarget(),d=e.getActiveCubeFace(),f=e.getActiveMipmapLevel(),p=e.xr.enabled;e.xr.enabled=!1;let v=n.texture.mipmapsAutoUpdate;n.texture.mipmapsAutoUpdate=!1;let m=!1;e.isWebGLRenderer===!0?m=e.state.buffers.depth.getReversed():m=e.reversedDepthBuffer,e.setRenderTarget(n,0,s),m&&e.autoClear===!1&&e.clearDepth(),e.render(t,r),e.setRenderTarget(n,1,s),m&&e.autoClear===!1&&e.clearDepth(),e.render(t,o),e.setRenderTarget(n,2,s),m&&e.autoClear===!1&&e.clearDepth(),e.render(t,a),e.setRenderTarget(n,3,s),m&&e.autoClear===!1&&e.clearDepth(),e.render(t,l),e.setRenderTarget(n,4,s),m&&e.autoClear===!1&&e.clearDepth(),e.render(t,c),n.texture.mipmapsAutoUpdate=v,e.setRenderTarget(n,5,s),m&&e.autoClear===!1&&e.clearDepth(),e.render(t,h),e.setRenderTarget(u,d,f),e.xr.enabled=p,n.texture.needsPMREMUpdate=!0}},dl=class extends fn{constructor(e=[]){super(),this.isArrayCamera=!0,this.isMultiViewCamera=!1,this.cameras=e,this.perCameraFrustumCulled=!1}};var Ju="\\[\\]\\.:\\/",Ix=new RegExp("["+Ju+"]","g"),Ku="[^"+Ju+"]",Lx="[^"+Ju.replace("\\.","")+"]",Nx=/((?:WC+[\/:])*)/.source.replace("WC",Ku),Dx=/(WCOD+)?/.source.replace("WCOD",Lx),Ox=/(?:\.(WC+)(?:\[(.+)\])?)?/.source.replace("WC",Ku),Ux=/\.(WC+)(?:\[(.+)\])?/.source.replace("WC",Ku),Fx=new RegExp("^"+Nx+Dx+Ox+Ux+"$"),Bx=["material","materials","bones","map"],mu=class{constructor(e,t,n){let s=n||_t.parseTrackName(t);this._targetGroup=e,this._bindings=e.subscribe_(t,s)}getValue(e,t){this.bind();let n=this._targetGroup.nCachedObjects_,s=this._bindings[n];s!==void 0&&s.getValue(e,t)}setValue(e,t){let n=this._bindings;for(let s=this._targetGroup.nCachedObjects_,r=n.length;s!==r;++s)n[s].setValue(e,t)}bind(){let e=this._bindings;for(let t=this._targetGroup.nCachedObjects_,n=e.length;t!==n;++t)e[t].bind()}unbind(){let e=this._bindings;for(let t=this._targetGroup.nCachedObjects_,n=e.length;t!==n;++t)e[t].unbind()}},_t=class i{constructor(e,t,n){this.path=t,this.parsedPath=n||i.parseTrackName(t),this.node=i.findNode(e,this.parsedPath.nodeName),this.rootNode=e,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}static create(e,t,n){return e&&e.isAnimationObjectGroup?new i.Composite(e,t,n):new i(e,t,n)}static sanitizeNodeName(e){return e.replace(/\s/g,"_").replace(Ix,"")}static parseTrackName(e){let t=Fx.exec(e);if(t===null)throw new Error("THREE.PropertyBinding: Cannot parse trackName: "+e);let n={nodeName:t[2],objectName:t[3],objectIndex:t[4],propertyName:t[5],propertyIndex:t[6]},s=n.nodeName&&n.nodeName.lastIndexOf(".");if(s!==void 0&&s!==-1){let r=n.nodeName.substring(s+1);Bx.indexOf(r)!==-1&&(n.nodeName=n.nodeName.substring(0,s),n.objectName=r)}if(n.propertyName===null||n.propertyName.length===0)throw new Error("THREE.PropertyBinding: can not parse propertyName from trackName: "+e);return n}static findNode(e,t){if(t===void 0||t===""||t==="."||t===-1||t===e.name||t===e.uuid)return e;if(e.skeleton){let n=e.skeleton.getBoneByName(t);if(n!==void 0)return n}if(e.children){let n=function(r){for(let o=0;o<r.length;o++){let a=r[o];if(a.name===t||a.uuid===t)return a;let l=n(a.children);if(l)return l}return null},s=n(e.children);if(s)return s}return null}_getValue_unavailable(){}_setValue_unavailable(){}_getValue_direct(e,t){e[t]=this.targetObject[this.propertyName]}_getValue_array(e,t){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)e[t++]=n[s]}_getValue_arrayElement(e,t){e[t]=this.resolvedProperty[this.propertyIndex]}_getValue_toArray(e,t){this.resolvedProperty.toArray(e,t)}_setValue_direct(e,t){this.targetObject[this.propertyName]=e[t]}_setValue_direct_setNeedsUpdate(e,t){this.targetObject[this.propertyName]=e[t],this.targetObject.needsUpdate=!0}_setValue_direct_setMatrixWorldNeedsUpdate(e,t){this.targetObject[this.propertyName]=e[t],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_array(e,t){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)n[s]=e[t++]}_setValue_array_setNeedsUpdate(e,t){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)n[s]=e[t++];this.targetObject.needsUpdate=!0}_setValue_array_setMatrixWorldNeedsUpdate(e,t){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)n[s]=e[t++];this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_arrayElement(e,t){this.resolvedProperty[this.propertyIndex]=e[t]}_setValue_arrayElement_setNeedsUpdate(e,t){this.resolvedProperty[this.propertyIndex]=e[t],this.targetObject.needsUpdate=!0}_setValue_arrayElement_setMatrixWorldNeedsUpdate(e,t){this.resolvedProperty[this.propertyIndex]=e[t],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_fromArray(e,t){this.resolvedProperty.fromArray(e,t)}_setValue_fromArray_setNeedsUpdate(e,t){this.resolvedProperty.fromArray(e,t),this.targetObject.needsUpdate=!0}_setValue_fromArray_setMatrixWorldNeedsUpdate(e,t){this.resolvedProperty.fromArray(e,t),this.targetObject.matrixWorldNeedsUpdate=!0}_getValue_unbound(e,t){this.bind(),this.getValue(e,t)}_setValue_unbound(e,t){this.bind(),this.setValue(e,t)}bind(){let e=this.node,t=this.parsedPath,n=t.objectName,s=t.propertyName,r=t.propertyIndex;if(e||(e=i.findNode(this.rootNode,t.nodeName),this.node=e),this.getValue=this._getValue_unavailable,this.setValue=this._setValue_unavailable,!e){Re("PropertyBinding: No target node found for track: "+this.path+".");return}if(n){let c=t.objectIndex;switch(n){case"materials":if(!e.material){Ne("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!e.material.materials){Ne("PropertyBinding: Can not bind to material.materials as node.material does not have a materials array.",this);return}e=e.material.materials;break;case"bones":if(!e.skeleton){Ne("PropertyBinding: Can not bind to bones as node does not have a skeleton.",this);return}e=e.skeleton.bones;for(let h=0;h<e.length;h++)if(e[h].name===c){c=h;break}break;case"map":if("map"in e){e=e.map;break}if(!e.material){Ne("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!e.material.map){Ne("PropertyBinding: Can not bind to material.map as node.material does not have a map.",this);return}e=e.material.map;break;default:if(e[n]===void 0){Ne("PropertyBinding: Can not bind to objectName of node undefined.",this);return}e=e[n]}if(c!==void 0){if(e[c]===void 0){Ne("PropertyBinding: Trying to bind to objectIndex of objectName, but is undefined.",this,e);return}e=e[c]}}let o=e[s];if(o===void 0){let c=t.nodeName;Ne("PropertyBinding: Trying to update property for track: "+c+"."+s+" but it wasn't found.",e);return}let a=this.Versioning.None;this.targetObject=e,e.isMaterial===!0?a=this.Versioning.NeedsUpdate:e.isObject3D===!0&&(a=this.Versioning.MatrixWorldNeedsUpdate);let l=this.BindingType.Direct;if(r!==void 0){if(s==="morphTargetInfluences"){if(!e.geometry){Ne("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.",this);return}if(!e.geometry.morphAttributes){Ne("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.morphAttributes.",this);return}e.morphTargetDictionary[r]!==void 0&&(r=e.morphTargetDictionary[r])}l=this.BindingType.ArrayElement,this.resolvedProperty=o,this.propertyIndex=r}else o.fromArray!==void 0&&o.toArray!==void 0?(l=this.BindingType.HasFromToArray,this.resolvedProperty=o):Array.isArray(o)?(l=this.BindingType.EntireArray,this.resolvedProperty=o):this.propertyName=s;this.getValue=this.GetterByBindingType[l],this.setValue=this.SetterByBindingTypeAndVersioning[l][a]}unbind(){this.node=null,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}};_t.Composite=mu;_t.prototype.BindingType={Direct:0,EntireArray:1,ArrayElement:2,HasFromToArray:3};_t.prototype.Versioning={None:0,NeedsUpdate:1,MatrixWorldNeedsUpdate:2};_t.prototype.GetterByBindingType=[_t.prototype._getValue_direct,_t.prototype._getValue_array,_t.prototype._getValue_arrayElement,_t.prototype._getValue_toArray];_t.prototype.SetterByBindingTypeAndVersioning=[[_t.prototype._setValue_direct,_t.prototype._setValue_direct_setNeedsUpdate,_t.prototype._setValue_direct_setMatrixWorldNeedsUpdate],[_t.prototype._setValue_array,_t.prototype._setValue_array_setNeedsUpdate,_t.prototype._setValue_array_setMatrixWorldNeedsUpdate],[_t.prototype._setValue_arrayElement,_t.prototype._setValue_arrayElement_setNeedsUpdate,_t.prototype._setValue_arrayElement_setMatrixWorldNeedsUpdate],[_t.prototype._setValue_fromArray,_t.prototype._setValue_fromArray_setNeedsUpdate,_t.prototype._setValue_fromArray_setMatrixWorldNeedsUpdate]];var xA=new Float32Array(1);var hp=new Le,xo=class{constructor(e,t,n=0,s=1/0){this.ray=new Kn(e,t),this.near=n,this.far=s,this.camera=null,this.layers=new qs,this.params={Mesh:{},Line:{threshold:1},LOD:{},Points:{threshold:1},Sprite:{}}}set(e,t){this.ray.set(e,t)}setFromCamera(e,t){t.isPerspectiveCamera?(this.ray.origin.setFromMatrixPosition(t.matrixWorld),this.ray.direction.set(e.x,e.y,.5).unproject(t).sub(this.ray.origin).normalize(),this.camera=t):t.isOrthographicCamera?(this.ray.origin.set(e.x,e.y,t.projectionMatrix.elements[14]).unproject(t),this.ray.direction.set(0,0,-1).transformDirection(t.matrixWorld),this.camera=t):Ne("Raycaster: Unsupported camera type: "+t.type)}setFromXRController(e){return hp.identity().extractRotation(e.matrixWorld),this.ray.origin.setFromMatrixPosition(e.matrixWorld),this.ray.direction.set(0,0,-1).applyMatrix4(hp),this}intersectObject(e,t=!0,n=[]){return gu(e,this,n,t),n.sort(up),n}intersectObjects(e,t=!0,n=[]){for(let s=0,r=e.length;s<r;s++)gu(e[s],this,n,t);return n.sort(up),n}};function up(i,e){return i.distance-e.distance}function gu(i,e,t,n){let s=!0;if(i.layers.test(e.layers)&&i.raycast(e,t)===!1&&(s=!1),s===!0&&n===!0){let r=i.children;for(let o=0,a=r.length;o<a;o++)gu(r[o],e,t,!0)}}var yu=class{static{this.prototype.isMatrix2=!0}constructor(e,t,n,s){this.elements=[1,0,0,1],e!==void 0&&this.set(e,t,n,s)}identity(){return this.set(1,0,0,1),this}fromArray(e,t=0){for(let n=0;n<4;n++)this.elements[n]=e[n+t];return this}set(e,t,n,s){let r=this.elements;return r[0]=e,r[2]=t,r[1]=n,r[3]=s,this}};var dp=new C,Na=new C,ks=new C,zs=new C,ru=new C,kx=new C,zx=new C,_n=class{constructor(e=new C,t=new C){this.start=e,this.end=t}set(e,t){return this.start.copy(e),this.end.copy(t),this}copy(e){return this.start.copy(e.start),this.end.copy(e.end),this}getCenter(e){return e.addVectors(this.start,this.end).multiplyScalar(.5)}delta(e){return e.subVectors(this.end,this.start)}distanceSq(){return this.start.distanceToSquared(this.end)}distance(){return this.start.distanceTo(this.end)}at(e,t){return this.delta(t).multiplyScalar(e).add(this.start)}closestPointToPointParameter(e,t){dp.subVectors(e,this.start),Na.subVectors(this.end,this.start);let n=Na.dot(Na);if(n===0)return 0;let r=Na.dot(dp)/n;return t&&(r=Ve(r,0,1)),r}closestPointToPoint(e,t,n){let s=this.closestPointToPointParameter(e,t);return this.delta(n).multiplyScalar(s).add(this.start)}distanceSqToLine3(e,t=kx,n=zx){let s=10000000000000001e-32,r,o,a=this.start,l=e.start,c=this.end,h=e.end;ks.subVectors(c,a),zs.subVectors(h,l),ru.subVectors(a,l);let u=ks.dot(ks),d=zs.dot(zs),f=zs.dot(ru);if(u<=s&&d<=s)return t.copy(a),n.copy(l),t.distanceToSquared(n);if(u<=s)r=0,o=f/d,o=Ve(o,0,1);else{let p=ks.dot(ru);if(d<=s)o=0,r=Ve(-p/u,0,1);else{let v=ks.dot(zs),m=u*d-v*v;m!==0?r=Ve((v*f-p*d)/m,0,1):r=0,o=(v*r+f)/d,o<0?(o=0,r=Ve(-p/u,0,1)):o>1&&(o=1,r=Ve((v-p)/u,0,1))}}return t.copy(a).addScaledVector(ks,r),n.copy(l).addScaledVector(zs,o),t.distanceToSquared(n)}applyMatrix4(e){return this.start.applyMatrix4(e),this.end.applyMatrix4(e),this}equals(e){return e.start.equals(this.start)&&e.end.equals(this.end)}clone(){return new this.constructor().copy(this)}};var _o=class extends Pn{constructor(e=10,t=10,n=4473924,s=8947848){n=new De(n),s=new De(s);let r=t/2,o=e/t,a=e/2,l=[],c=[];for(let d=0,f=0,p=-a;d<=t;d++,p+=o){l.push(-a,0,p,a,0,p),l.push(p,0,-a,p,0,a);let v=d===r?n:s;v.toArray(c,f),f+=3,v.toArray(c,f),f+=3,v.toArray(c,f),f+=3,v.toArray(c,f),f+=3}let h=new rt;h.setAttribute("position",new vt(l,3)),h.setAttribute("color",new vt(c,3));let u=new xn({vertexColors:!0,toneMapped:!1});super(h,u),this.type="GridHelper"}dispose(){super.dispose(),this.geometry.dispose(),this.material.dispose()}};function Qu(i,e,t,n){let s=Vx(n);switch(t){case Fu:return i*e;case ku:return i*e/s.components*s.byteLength;case Mo:return i*e/s.components*s.byteLength;case Xi:return i*e*2/s.components*s.byteLength;case _l:return i*e*2/s.components*s.byteLength;case Bu:return i*e*3/s.components*s.byteLength;case Rn:return i*e*4/s.components*s.byteLength;case vl:return i*e*4/s.components*s.byteLength;case So:case wo:return Math.floor((i+3)/4)*Math.floor((e+3)/4)*8;case To:case Ao:return Math.floor((i+3)/4)*Math.floor((e+3)/4)*16;case Ml:case wl:return Math.max(i,16)*Math.max(e,8)/4;case bl:case Sl:return Math.max(i,8)*Math.max(e,8)/2;case Tl:case Al:case Cl:case Rl:return Math.floor((i+3)/4)*Math.floor((e+3)/4)*8;case El:case Eo:case Pl:return Math.floor((i+3)/4)*Math.floor((e+3)/4)*16;case Il:return Math.floor((i+3)/4)*Math.floor((e+3)/4)*16;case Ll:return Math.floor((i+4)/5)*Math.floor((e+3)/4)*16;case Nl:return Math.floor((i+4)/5)*Math.floor((e+4)/5)*16;case Dl:return Math.floor((i+5)/6)*Math.floor((e+4)/5)*16;case Ol:return Math.floor((i+5)/6)*Math.floor((e+5)/6)*16;case Ul:return Math.floor((i+7)/8)*Math.floor((e+4)/5)*16;case Fl:return Math.floor((i+7)/8)*Math.floor((e+5)/6)*16;case Bl:return Math.floor((i+7)/8)*Math.floor((e+7)/8)*16;case kl:return Math.floor((i+9)/10)*Math.floor((e+4)/5)*16;case zl:return Math.floor((i+9)/10)*Math.floor((e+5)/6)*16;case Vl:return Math.floor((i+9)/10)*Math.floor((e+7)/8)*16;case Gl:return Math.floor((i+9)/10)*Math.floor((e+9)/10)*16;case Hl:return Math.floor((i+11)/12)*Math.floor((e+9)/10)*16;case Wl:return Math.floor((i+11)/12)*Math.floor((e+11)/12)*16;case Xl:case ql:case $l:return Math.ceil(i/4)*Math.ceil(e/4)*16;case Yl:case jl:return Math.ceil(i/4)*Math.ceil(e/4)*8;case Co:case Zl:return Math.ceil(i/4)*Math.ceil(e/4)*16}throw new Error(`Unable to determine texture byte length for ${t} format.`)}function Vx(i){switch(i){case vn:case Nu:return{byteLength:1,components:1};case or:case Du:case Qn:return{byteLength:2,components:1};case yl:case xl:return{byteLength:2,components:4};case Wn:case gl:case Cn:return{byteLength:4,components:1};case Ou:case Uu:return{byteLength:4,components:3}}throw new Error(`THREE.TextureUtils: Unknown texture type ${i}.`)}typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("register",{detail:{revision:"187"}}));typeof window<"u"&&(window.__THREE__?Re("WARNING: Multiple instances of Three.js being imported."):window.__THREE__="187");function Tm(){let i=null,e=!1,t=null,n=null;function s(r,o){n=i.requestAnimationFrame(s),t(r,o)}return{start:function(){e!==!0&&t!==null&&i!==null&&(n=i.requestAnimationFrame(s),e=!0)},stop:function(){i!==null&&i.cancelAnimationFrame(n),e=!1},setAnimationLoop:function(r){t=r},setContext:function(r){i=r}}}function Gx(i){let e=new WeakMap;function t(a,l){let c=a.array,h=a.usage,u=c.byteLength,d=i.createBuffer();i.bindBuffer(l,d),i.bufferData(l,c,h),a.onUploadCallback();let f;if(c instanceof Float32Array)f=i.FLOAT;else if(typeof Float16Array<"u"&&c instanceof Float16Array)f=i.HALF_FLOAT;else if(c instanceof Uint16Array)a.isFloat16BufferAttribute?f=i.HALF_FLOAT:f=i.UNSIGNED_SHORT;else if(c instanceof Int16Array)f=i.SHORT;else if(c instanceof Uint32Array)f=i.UNSIGNED_INT;else if(c instanceof Int32Array)f=i.INT;else if(c instanceof Int8Array)f=i.BYTE;else if(c instanceof Uint8Array)f=i.UNSIGNED_BYTE;else if(c instanceof Uint8ClampedArray)f=i.UNSIGNED_BYTE;else throw new Error("THREE.WebGLAttributes: Unsupported buffer data format: "+c);return{buffer:d,type:f,bytesPerElement:c.BYTES_PER_ELEMENT,version:a.version,size:u}}function n(a,l,c){let h=l.array,u=l.updateRanges;if(i.bindBuffer(c,a),u.length===0)i.bufferSubData(c,0,h);else{u.sort((f,p)=>f.start-p.start);let d=0;for(let f=1;f<u.length;f++){let p=u[d],v=u[f];v.start<=p.start+p.count+1?p.count=Math.max(p.count,v.start+v.count-p.start):(++d,u[d]=v)}u.length=d+1;for(let f=0,p=u.length;f<p;f++){let v=u[f];i.bufferSubData(c,v.start*h.BYTES_PER_ELEMENT,h,v.start,v.count)}l.clearUpdateRanges()}l.onUploadCallback()}function s(a){return a.isInterleavedBufferAttribute&&(a=a.data),e.get(a)}function r(a){a.isInterleavedBufferAttribute&&(a=a.data);let l=e.get(a);l&&(i.deleteBuffer(l.buffer),e.delete(a))}function o(a,l){if(a.isInterleavedBufferAttribute&&(a=a.data),a.isGLBufferAttribute){let h=e.get(a);(!h||h.version<a.version)&&e.set(a,{buffer:a.buffer,type:a.type,bytesPerElement:a.elementSize,version:a.version});return}let c=e.get(a);if(c===void 0)e.set(a,t(a,l));else if(c.version<a.version){if(c.size!==a.array.byteLength)throw new Error("THREE.WebGLAttributes: The size of the buffer attribute's array buffer does not match the original size. Resizing buffer attributes is not supported.");n(c.buffer,a,l),c.version=a.version}}return{get:s,remove:r,update:o}}var Hx=`#ifdef USE_ALPHAHASH
	if ( diffuseColor.a < getAlphaHashThreshold( vPosition ) ) discard;
#endif`,Wx=`#ifdef USE_ALPHAHASH
	const float ALPHA_HASH_SCALE = 0.05;
	float hash2D( vec2 value ) {
		return fract( 1.0e4 * sin( 17.0 * value.x + 0.1 * value.y ) * ( 0.1 + abs( sin( 13.0 * value.y + value.x ) ) ) );
	}
	float hash3D( vec3 value ) {
		return hash2D( vec2( hash2D( value.xy ), value.z ) );
	}
	float getAlphaHashThreshold( vec3 position ) {
		float maxDeriv = max(
			length( dFdx( position.xyz ) ),
			length( dFdy( position.xyz ) )
		);
		float pixScale = 1.0 / ( ALPHA_HASH_SCALE * maxDeriv );
		vec2 pixScales = vec2(
			exp2( floor( log2( pixScale ) ) ),
			exp2( ceil( log2( pixScale ) ) )
		);
		vec2 alpha = vec2(
			hash3D( floor( pixScales.x * position.xyz ) ),
			hash3D( floor( pixScales.y * position.xyz ) )
		);
		float lerpFactor = fract( log2( pixScale ) );
		float x = ( 1.0 - lerpFactor ) * alpha.x + lerpFactor * alpha.y;
		float a = min( lerpFactor, 1.0 - lerpFactor );
		vec3 cases = vec3(
			x * x / ( 2.0 * a * ( 1.0 - a ) ),
			( x - 0.5 * a ) / ( 1.0 - a ),
			1.0 - ( ( 1.0 - x ) * ( 1.0 - x ) / ( 2.0 * a * ( 1.0 - a ) ) )
		);
		float threshold = ( x < ( 1.0 - a ) )
			? ( ( x < a ) ? cases.x : cases.y )
			: cases.z;
		return clamp( threshold , 1.0e-6, 1.0 );
	}
#endif`,Xx=`#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, vAlphaMapUv ).g;
#endif`,qx=`#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,$x=`#ifdef USE_ALPHATEST
	#ifdef ALPHA_TO_COVERAGE
	diffuseColor.a = smoothstep( alphaTest, alphaTest + fwidth( diffuseColor.a ), diffuseColor.a );
	if ( diffuseColor.a == 0.0 ) discard;
	#else
	if ( diffuseColor.a < alphaTest ) discard;
	#endif
#endif`,Yx=`#ifdef USE_ALPHATEST
	uniform float alphaTest;
#endif`,jx=`#ifdef USE_AOMAP
	float ambientOcclusion = ( texture2D( aoMap, vAoMapUv ).r - 1.0 ) * aoMapIntensity + 1.0;
	reflectedLight.indirectDiffuse *= ambientOcclusion;
	#if defined( USE_CLEARCOAT ) 
		clearcoatSpecularIndirect *= ambientOcclusion;
	#endif
	#if defined( USE_SHEEN ) 
		sheenSpecularIndirect *= ambientOcclusion;
	#endif
	#if defined( USE_ENVMAP ) && defined( STANDARD )
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		reflectedLight.indirectSpecular *= computeSpecularOcclusion( dotNV, ambientOcclusion, material.roughness );
	#endif
#endif`,Zx=`#ifdef USE_AOMAP
	uniform sampler2D aoMap;
	uniform float aoMapIntensity;
#endif`,Jx=`#ifdef USE_BATCHING
	#if ! defined( GL_ANGLE_multi_draw )
	#define gl_DrawID _gl_DrawID
	uniform int _gl_DrawID;
	#endif
	uniform highp sampler2D batchingTexture;
	uniform highp usampler2D batchingIdTexture;
	mat4 getBatchingMatrix( const in float i ) {
		int size = textureSize( batchingTexture, 0 ).x;
		int j = int( i ) * 4;
		int x = j % size;
		int y = j / size;
		vec4 v1 = texelFetch( batchingTexture, ivec2( x, y ), 0 );
		vec4 v2 = texelFetch( batchingTexture, ivec2( x + 1, y ), 0 );
		vec4 v3 = texelFetch( batchingTexture, ivec2( x + 2, y ), 0 );
		vec4 v4 = texelFetch( batchingTexture, ivec2( x + 3, y ), 0 );
		return mat4( v1, v2, v3, v4 );
	}
	float getIndirectIndex( const in int i ) {
		int size = textureSize( batchingIdTexture, 0 ).x;
		int x = i % size;
		int y = i / size;
		return float( texelFetch( batchingIdTexture, ivec2( x, y ), 0 ).r );
	}
#endif
#ifdef USE_BATCHING_COLOR
	uniform sampler2D batchingColorTexture;
	vec4 getBatchingColor( const in float i ) {
		int size = textureSize( batchingColorTexture, 0 ).x;
		int j = int( i );
		int x = j % size;
		int y = j / size;
		return texelFetch( batchingColorTexture, ivec2( x, y ), 0 );
	}
#endif`,Kx=`#ifdef USE_BATCHING
	mat4 batchingMatrix = getBatchingMatrix( getIndirectIndex( gl_DrawID ) );
#endif`,Qx=`vec3 transformed = vec3( position );
#ifdef USE_ALPHAHASH
	vPosition = vec3( position );
#endif`,e_=`vec3 objectNormal = vec3( normal );
#ifdef USE_TANGENT
	vec3 objectTangent = vec3( tangent.xyz );
#endif`,t_=`float G_BlinnPhong_Implicit( ) {
	return 0.25;
}
float D_BlinnPhong( const in float shininess, const in float dotNH ) {
	return RECIPROCAL_PI * ( shininess * 0.5 + 1.0 ) * pow( dotNH, shininess );
}
vec3 BRDF_BlinnPhong( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in vec3 specularColor, const in float shininess ) {
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNH = saturate( dot( normal, halfDir ) );
	float dotVH = saturate( dot( viewDir, halfDir ) );
	vec3 F = F_Schlick( specularColor, 1.0, dotVH );
	float G = G_BlinnPhong_Implicit( );
	float D = D_BlinnPhong( shininess, dotNH );
	return F * ( G * D );
} // validated`,n_=`#ifdef USE_IRIDESCENCE
	const mat3 XYZ_TO_REC709 = mat3(
		 3.2404542, -0.9692660,  0.0556434,
		-1.5371385,  1.8760108, -0.2040259,
		-0.4985314,  0.0415560,  1.0572252
	);
	vec3 Fresnel0ToIor( vec3 fresnel0 ) {
		vec3 sqrtF0 = sqrt( fresnel0 );
		return ( vec3( 1.0 ) + sqrtF0 ) / ( vec3( 1.0 ) - sqrtF0 );
	}
	vec3 IorToFresnel0( vec3 transmittedIor, float incidentIor ) {
		return pow2( ( transmittedIor - vec3( incidentIor ) ) / ( transmittedIor + vec3( incidentIor ) ) );
	}
	float IorToFresnel0( float transmittedIor, float incidentIor ) {
		return pow2( ( transmittedIor - incidentIor ) / ( transmittedIor + incidentIor ));
	}
	vec3 evalSensitivity( float OPD, vec3 shift ) {
		float phase = 2.0 * PI * OPD * 1.0e-9;
		vec3 val = vec3( 5.4856e-13, 4.4201e-13, 5.2481e-13 );
		vec3 pos = vec3( 1.6810e+06, 1.7953e+06, 2.2084e+06 );
		vec3 var = vec3( 4.3278e+09, 9.3046e+09, 6.6121e+09 );
		vec3 xyz = val * sqrt( 2.0 * PI * var ) * cos( pos * phase + shift ) * exp( - pow2( phase ) * var );
		xyz.x += 9.7470e-14 * sqrt( 2.0 * PI * 4.5282e+09 ) * cos( 2.2399e+06 * phase + shift[ 0 ] ) * exp( - 4.5282e+09 * pow2( phase ) );
		xyz /= 1.0685e-7;
		vec3 rgb = XYZ_TO_REC709 * xyz;
		return rgb;
	}
	vec3 evalIridescence( float outsideIOR, float eta2, float cosTheta1, float thinFilmThickness, vec3 baseF0 ) {
		vec3 I;
		float iridescenceIOR = mix( outsideIOR, eta2, smoothstep( 0.0, 0.03, thinFilmThickness ) );
		float sinTheta2Sq = pow2( outsideIOR / iridescenceIOR ) * ( 1.0 - pow2( cosTheta1 ) );
		float cosTheta2Sq = 1.0 - sinTheta2Sq;
		if ( cosTheta2Sq < 0.0 ) {
			return vec3( 1.0 );
		}
		float cosTheta2 = sqrt( cosTheta2Sq );
		float R0 = IorToFresnel0( iridescenceIOR, outsideIOR );
		float R12 = F_Schlick( R0, 1.0, cosTheta1 );
		float T121 = 1.0 - R12;
		float phi12 = 0.0;
		if ( iridescenceIOR < outsideIOR ) phi12 = PI;
		float phi21 = PI - phi12;
		vec3 baseIOR = Fresnel0ToIor( clamp( baseF0, 0.0, 0.9999 ) );		vec3 R1 = IorToFresnel0( baseIOR, iridescenceIOR );
		vec3 R23 = F_Schlick( R1, 1.0, cosTheta2 );
		vec3 phi23 = vec3( 0.0 );
		if ( baseIOR[ 0 ] < iridescenceIOR ) phi23[ 0 ] = PI;
		if ( baseIOR[ 1 ] < iridescenceIOR ) phi23[ 1 ] = PI;
		if ( baseIOR[ 2 ] < iridescenceIOR ) phi23[ 2 ] = PI;
		float OPD = 2.0 * iridescenceIOR * thinFilmThickness * cosTheta2;
		vec3 phi = vec3( phi21 ) + phi23;
		vec3 R123 = clamp( R12 * R23, 1e-5, 0.9999 );
		vec3 r123 = sqrt( R123 );
		vec3 Rs = pow2( T121 ) * R23 / ( vec3( 1.0 ) - R123 );
		vec3 C0 = R12 + Rs;
		I = C0;
		vec3 Cm = Rs - T121;
		for ( int m = 1; m <= 2; ++ m ) {
			Cm *= r123;
			vec3 Sm = 2.0 * evalSensitivity( float( m ) * OPD, float( m ) * phi );
			I += Cm * Sm;
		}
		return max( I, vec3( 0.0 ) );
	}
#endif`,i_=`#ifdef USE_BUMPMAP
	uniform sampler2D bumpMap;
	uniform float bumpScale;
	vec2 dHdxy_fwd() {
		vec2 dSTdx = dFdx( vBumpMapUv );
		vec2 dSTdy = dFdy( vBumpMapUv );
		float Hll = bumpScale * texture2D( bumpMap, vBumpMapUv ).x;
		float dBx = bumpScale * texture2D( bumpMap, vBumpMapUv + dSTdx ).x - Hll;
		float dBy = bumpScale * texture2D( bumpMap, vBumpMapUv + dSTdy ).x - Hll;
		return vec2( dBx, dBy );
	}
	vec3 perturbNormalArb( vec3 surf_pos, vec3 surf_norm, vec2 dHdxy, float faceDirection ) {
		vec3 vSigmaX = normalize( dFdx( surf_pos.xyz ) );
		vec3 vSigmaY = normalize( dFdy( surf_pos.xyz ) );
		vec3 vN = surf_norm;
		vec3 R1 = cross( vSigmaY, vN );
		vec3 R2 = cross( vN, vSigmaX );
		float fDet = dot( vSigmaX, R1 ) * faceDirection;
		vec3 vGrad = sign( fDet ) * ( dHdxy.x * R1 + dHdxy.y * R2 );
		return normalize( abs( fDet ) * surf_norm - vGrad );
	}
#endif`,s_=`#if NUM_CLIPPING_PLANES > 0
	vec4 plane;
	#ifdef ALPHA_TO_COVERAGE
		float distanceToPlane, distanceGradient;
		float clipOpacity = 1.0;
		#pragma unroll_loop_start
		for ( int i = 0; i < UNION_CLIPPING_PLANES; i ++ ) {
			plane = clippingPlanes[ i ];
			distanceToPlane = - dot( vClipPosition, plane.xyz ) + plane.w;
			distanceGradient = fwidth( distanceToPlane ) / 2.0;
			clipOpacity *= smoothstep( - distanceGradient, distanceGradient, distanceToPlane );
			if ( clipOpacity == 0.0 ) discard;
		}
		#pragma unroll_loop_end
		#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
			float unionClipOpacity = 1.0;
			#pragma unroll_loop_start
			for ( int i = UNION_CLIPPING_PLANES; i < NUM_CLIPPING_PLANES; i ++ ) {
				plane = clippingPlanes[ i ];
				distanceToPlane = - dot( vClipPosition, plane.xyz ) + plane.w;
				distanceGradient = fwidth( distanceToPlane ) / 2.0;
				unionClipOpacity *= 1.0 - smoothstep( - distanceGradient, distanceGradient, distanceToPlane );
			}
			#pragma unroll_loop_end
			clipOpacity *= 1.0 - unionClipOpacity;
		#endif
		diffuseColor.a *= clipOpacity;
		if ( diffuseColor.a == 0.0 ) discard;
	#else
		#pragma unroll_loop_start
		for ( int i = 0; i < UNION_CLIPPING_PLANES; i ++ ) {
			plane = clippingPlanes[ i ];
			if ( dot( vClipPosition, plane.xyz ) > plane.w ) discard;
		}
		#pragma unroll_loop_end
		#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
			bool clipped = true;
			#pragma unroll_loop_start
			for ( int i = UNION_CLIPPING_PLANES; i < NUM_CLIPPING_PLANES; i ++ ) {
				plane = clippingPlanes[ i ];
				clipped = ( dot( vClipPosition, plane.xyz ) > plane.w ) && clipped;
			}
			#pragma unroll_loop_end
			if ( clipped ) discard;
		#endif
	#endif
#endif`,r_=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
	uniform vec4 clippingPlanes[ NUM_CLIPPING_PLANES ];
#endif`,o_=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
#endif`,a_=`#if NUM_CLIPPING_PLANES > 0
	vClipPosition = - mvPosition.xyz;
#endif`,l_=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	diffuseColor *= vColor;
#endif`,c_=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	varying vec4 vColor;
#endif`,h_=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	varying vec4 vColor;
#endif`,u_=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	vColor = vec4( 1.0 );
#endif
#ifdef USE_COLOR_ALPHA
	vColor *= color;
#elif defined( USE_COLOR )
	vColor.rgb *= color;
#endif
#ifdef USE_INSTANCING_COLOR
	vColor.rgb *= instanceColor.rgb;
#endif
#ifdef USE_BATCHING_COLOR
	vColor *= getBatchingColor( getIndirectIndex( gl_DrawID ) );
#endif`,d_=`#define PI 3.141592653589793
#define PI2 6.283185307179586
#define PI_HALF 1.5707963267948966
#define RECIPROCAL_PI 0.3183098861837907
#define RECIPROCAL_PI2 0.15915494309189535
#define EPSILON 1e-6
#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
#define whiteComplement( a ) ( 1.0 - saturate( a ) )
float pow2( const in float x ) { return x*x; }
vec3 pow2( const in vec3 x ) { return x*x; }
float pow3( const in float x ) { return x*x*x; }
float pow4( const in float x ) { float x2 = x*x; return x2*x2; }
float max3( const in vec3 v ) { return max( max( v.x, v.y ), v.z ); }
float average( const in vec3 v ) { return dot( v, vec3( 0.3333333 ) ); }
highp float rand( const in vec2 uv ) {
	const highp float a = 12.9898, b = 78.233, c = 43758.5453;
	highp float dt = dot( uv.xy, vec2( a,b ) ), sn = mod( dt, PI );
	return fract( sin( sn ) * c );
}
#ifdef HIGH_PRECISION
	float precisionSafeLength( vec3 v ) { return length( v ); }
#else
	float precisionSafeLength( vec3 v ) {
		float maxComponent = max3( abs( v ) );
		return length( v / maxComponent ) * maxComponent;
	}
#endif
struct IncidentLight {
	vec3 color;
	vec3 direction;
	bool visible;
};
struct ReflectedLight {
	vec3 directDiffuse;
	vec3 directSpecular;
	vec3 indirectDiffuse;
	vec3 indirectSpecular;
};
#ifdef USE_ALPHAHASH
	varying vec3 vPosition;
#endif
vec3 transformDirection( in vec3 dir, in mat4 matrix ) {
	return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );
}
#define inverseTransformDirection transformDirectionByInverseViewMatrix
vec3 transformNormalByInverseViewMatrix( in vec3 normal, in mat4 viewMatrix ) {
	return normalize( ( vec4( normal, 0.0 ) * viewMatrix ).xyz );
}
vec3 transformDirectionByInverseViewMatrix( in vec3 dir, in mat4 viewMatrix ) {
	return normalize( ( vec4( dir, 0.0 ) * viewMatrix ).xyz );
}
bool isPerspectiveMatrix( mat4 m ) {
	return m[ 2 ][ 3 ] == - 1.0;
}
vec2 equirectUv( in vec3 dir ) {
	float u = atan( dir.z, dir.x ) * RECIPROCAL_PI2 + 0.5;
	float v = asin( clamp( dir.y, - 1.0, 1.0 ) ) * RECIPROCAL_PI + 0.5;
	return vec2( u, v );
}
vec3 BRDF_Lambert( const in vec3 diffuseColor ) {
	return RECIPROCAL_PI * diffuseColor;
}
vec3 F_Schlick( const in vec3 f0, const in float f90, const in float dotVH ) {
	float fresnel = exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH );
	return f0 * ( 1.0 - fresnel ) + ( f90 * fresnel );
}
float F_Schlick( const in float f0, const in float f90, const in float dotVH ) {
	float fresnel = exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH );
	return f0 * ( 1.0 - fresnel ) + ( f90 * fresnel );
} // validated`,f_=`vec3 transformedNormal = objectNormal;
#ifdef USE_TANGENT
	vec3 transformedTangent = objectTangent;
#endif
#ifdef USE_BATCHING
	mat3 bm = mat3( batchingMatrix );
	transformedNormal /= vec3( dot( bm[ 0 ], bm[ 0 ] ), dot( bm[ 1 ], bm[ 1 ] ), dot( bm[ 2 ], bm[ 2 ] ) );
	transformedNormal = bm * transformedNormal;
	#ifdef USE_TANGENT
		transformedTangent = bm * transformedTangent;
	#endif
#endif
#ifdef USE_INSTANCING
	mat3 im = mat3( instanceMatrix );
	transformedNormal /= vec3( dot( im[ 0 ], im[ 0 ] ), dot( im[ 1 ], im[ 1 ] ), dot( im[ 2 ], im[ 2 ] ) );
	transformedNormal = im * transformedNormal;
	#ifdef USE_TANGENT
		transformedTangent = im * transformedTangent;
	#endif
#endif
transformedNormal = normalMatrix * transformedNormal;
#ifdef FLIP_SIDED
	transformedNormal = - transformedNormal;
#endif
#ifdef USE_TANGENT
	transformedTangent = ( modelViewMatrix * vec4( transformedTangent, 0.0 ) ).xyz;
#endif`,p_=`#ifdef USE_DISPLACEMENTMAP
	uniform sampler2D displacementMap;
	uniform float displacementScale;
	uniform float displacementBias;
#endif`,m_=`#ifdef USE_DISPLACEMENTMAP
	transformed += normalize( objectNormal ) * ( texture2D( displacementMap, vDisplacementMapUv ).x * displacementScale + displacementBias );
#endif`,g_=`#ifdef USE_EMISSIVEMAP
	vec4 emissiveColor = texture2D( emissiveMap, vEmissiveMapUv );
	#ifdef DECODE_VIDEO_TEXTURE_EMISSIVE
		emissiveColor = sRGBTransferEOTF( emissiveColor );
	#endif
	totalEmissiveRadiance *= emissiveColor.rgb;
#endif`,y_=`#ifdef USE_EMISSIVEMAP
	uniform sampler2D emissiveMap;
#endif`,x_="gl_FragColor = linearToOutputTexel( gl_FragColor );",__=`vec4 LinearTransferOETF( in vec4 value ) {
	return value;
}
vec4 sRGBTransferEOTF( in vec4 value ) {
	return vec4( mix( pow( value.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), value.rgb * 0.0773993808, vec3( lessThanEqual( value.rgb, vec3( 0.04045 ) ) ) ), value.a );
}
vec4 sRGBTransferOETF( in vec4 value ) {
	return vec4( mix( pow( value.rgb, vec3( 0.41666 ) ) * 1.055 - vec3( 0.055 ), value.rgb * 12.92, vec3( lessThanEqual( value.rgb, vec3( 0.0031308 ) ) ) ), value.a );
}`,v_=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vec3 cameraToFrag;
		if ( isOrthographic ) {
			cameraToFrag = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToFrag = normalize( vWorldPosition - cameraPosition );
		}
		vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vec3 reflectVec = reflect( cameraToFrag, worldNormal );
		#else
			vec3 reflectVec = refract( cameraToFrag, worldNormal, refractionRatio );
		#endif
	#else
		vec3 reflectVec = vReflect;
	#endif
	#ifdef ENVMAP_TYPE_CUBE
		vec4 envColor = textureCube( envMap, envMapRotation * reflectVec );
		#ifdef ENVMAP_BLENDING_MULTIPLY
			outgoingLight = mix( outgoingLight, outgoingLight * envColor.xyz, specularStrength * reflectivity );
		#elif defined( ENVMAP_BLENDING_MIX )
			outgoingLight = mix( outgoingLight, envColor.xyz, specularStrength * reflectivity );
		#elif defined( ENVMAP_BLENDING_ADD )
			outgoingLight += envColor.xyz * specularStrength * reflectivity;
		#endif
	#endif
#endif`,b_=`#ifdef USE_ENVMAP
	uniform float envMapIntensity;
	uniform mat3 envMapRotation;
	uniform samplerCube envMap;
	#ifdef ENVMAP_TYPE_PMREM
		float roughnessToMip( const in float roughness ) {
			float r = clamp( roughness, 0.0, 1.0 );
			return ENVMAP_MAX_LOD * r * ( 2.0 - r );
		}
	#endif
#endif`,M_=`#ifdef USE_ENVMAP
	uniform float reflectivity;
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		varying vec3 vWorldPosition;
		uniform float refractionRatio;
	#else
		varying vec3 vReflect;
	#endif
#endif`,S_=`#ifdef USE_ENVMAP
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		
		varying vec3 vWorldPosition;
	#else
		varying vec3 vReflect;
		uniform float refractionRatio;
	#endif
#endif`,w_=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vWorldPosition = worldPosition.xyz;
	#else
		vec3 cameraToVertex;
		if ( isOrthographic ) {
			cameraToVertex = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToVertex = normalize( worldPosition.xyz - cameraPosition );
		}
		vec3 worldNormal = transformNormalByInverseViewMatrix( transformedNormal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vReflect = reflect( cameraToVertex, worldNormal );
		#else
			vReflect = refract( cameraToVertex, worldNormal, refractionRatio );
		#endif
	#endif
#endif`,T_=`#ifdef USE_FOG
	vFogDepth = - mvPosition.z;
#endif`,A_=`#ifdef USE_FOG
	varying float vFogDepth;
#endif`,E_=`#ifdef USE_FOG
	#ifdef FOG_EXP2
		float fogFactor = 1.0 - exp( - fogDensity * fogDensity * vFogDepth * vFogDepth );
	#else
		float fogFactor = smoothstep( fogNear, fogFar, vFogDepth );
	#endif
	gl_FragColor.rgb = mix( gl_FragColor.rgb, fogColor, fogFactor );
#endif`,C_=`#ifdef USE_FOG
	uniform vec3 fogColor;
	varying float vFogDepth;
	#ifdef FOG_EXP2
		uniform float fogDensity;
	#else
		uniform float fogNear;
		uniform float fogFar;
	#endif
#endif`,R_=`#ifdef USE_GRADIENTMAP
	uniform sampler2D gradientMap;
#endif
vec3 getGradientIrradiance( vec3 normal, vec3 lightDirection ) {
	float dotNL = dot( normal, lightDirection );
	vec2 coord = vec2( dotNL * 0.5 + 0.5, 0.0 );
	#ifdef USE_GRADIENTMAP
		return vec3( texture2D( gradientMap, coord ).r );
	#else
		vec2 fw = fwidth( coord ) * 0.5;
		return mix( vec3( 0.7 ), vec3( 1.0 ), smoothstep( 0.7 - fw.x, 0.7 + fw.x, coord.x ) );
	#endif
}`,P_=`#ifdef USE_LIGHTMAP
	uniform sampler2D lightMap;
	uniform float lightMapIntensity;
#endif`,I_=`LambertMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularStrength = specularStrength;`,L_=`varying vec3 vViewPosition;
struct LambertMaterial {
	vec3 diffuseColor;
	float specularStrength;
};
void RE_Direct_Lambert( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in LambertMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Lambert( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in LambertMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_Lambert
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Lambert`,N_=`uniform bool receiveShadow;
uniform vec3 ambientLightColor;
#if defined( USE_LIGHT_PROBES )
	uniform vec3 lightProbe[ 9 ];
#endif
vec3 shGetIrradianceAt( in vec3 normal, in vec3 shCoefficients[ 9 ] ) {
	float x = normal.x, y = normal.y, z = normal.z;
	vec3 result = shCoefficients[ 0 ] * 0.886227;
	result += shCoefficients[ 1 ] * 2.0 * 0.511664 * y;
	result += shCoefficients[ 2 ] * 2.0 * 0.511664 * z;
	result += shCoefficients[ 3 ] * 2.0 * 0.511664 * x;
	result += shCoefficients[ 4 ] * 2.0 * 0.429043 * x * y;
	result += shCoefficients[ 5 ] * 2.0 * 0.429043 * y * z;
	result += shCoefficients[ 6 ] * ( 0.743125 * z * z - 0.247708 );
	result += shCoefficients[ 7 ] * 2.0 * 0.429043 * x * z;
	result += shCoefficients[ 8 ] * 0.429043 * ( x * x - y * y );
	return result;
}
vec3 getLightProbeIrradiance( const in vec3 lightProbe[ 9 ], const in vec3 normal ) {
	vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
	vec3 irradiance = shGetIrradianceAt( worldNormal, lightProbe );
	return irradiance;
}
vec3 getAmbientLightIrradiance( const in vec3 ambientLightColor ) {
	vec3 irradiance = ambientLightColor;
	return irradiance;
}
float getDistanceAttenuation( const in float lightDistance, const in float cutoffDistance, const in float decayExponent ) {
	float distanceFalloff = 1.0 / max( pow( lightDistance, decayExponent ), 0.01 );
	if ( cutoffDistance > 0.0 ) {
		distanceFalloff *= pow2( saturate( 1.0 - pow4( lightDistance / cutoffDistance ) ) );
	}
	return distanceFalloff;
}
float getSpotAttenuation( const in float coneCosine, const in float penumbraCosine, const in float angleCosine ) {
	return smoothstep( coneCosine, penumbraCosine, angleCosine );
}
#if NUM_SUN_LIGHTS > 0
	struct SunLight {
		vec3 direction;
		vec3 color;
	};
	uniform SunLight sunLights[ NUM_SUN_LIGHTS ];
	void getSunLightInfo( const in SunLight sunLight, out IncidentLight light ) {
		light.color = sunLight.color;
		light.direction = sunLight.direction;
		light.visible = true;
	}
#endif
#if NUM_DIR_LIGHTS > 0
	struct DirectionalLight {
		vec3 direction;
		vec3 color;
	};
	uniform DirectionalLight directionalLights[ NUM_DIR_LIGHTS ];
	void getDirectionalLightInfo( const in DirectionalLight directionalLight, out IncidentLight light ) {
		light.color = directionalLight.color;
		light.direction = directionalLight.direction;
		light.visible = true;
	}
#endif
#if NUM_POINT_LIGHTS > 0
	struct PointLight {
		vec3 position;
		vec3 color;
		float distance;
		float decay;
	};
	uniform PointLight pointLights[ NUM_POINT_LIGHTS ];
	void getPointLightInfo( const in PointLight pointLight, const in vec3 geometryPosition, out IncidentLight light ) {
		vec3 lVector = pointLight.position - geometryPosition;
		light.direction = normalize( lVector );
		float lightDistance = length( lVector );
		light.color = pointLight.color;
		light.color *= getDistanceAttenuation( lightDistance, pointLight.distance, pointLight.decay );
		light.visible = ( light.color != vec3( 0.0 ) );
	}
#endif
#if NUM_SPOT_LIGHTS > 0
	struct SpotLight {
		vec3 position;
		vec3 direction;
		vec3 color;
		float distance;
		float decay;
		float coneCos;
		float penumbraCos;
	};
	uniform SpotLight spotLights[ NUM_SPOT_LIGHTS ];
	void getSpotLightInfo( const in SpotLight spotLight, const in vec3 geometryPosition, out IncidentLight light ) {
		vec3 lVector = spotLight.position - geometryPosition;
		light.direction = normalize( lVector );
		float angleCos = dot( light.direction, spotLight.direction );
		float spotAttenuation = getSpotAttenuation( spotLight.coneCos, spotLight.penumbraCos, angleCos );
		if ( spotAttenuation > 0.0 ) {
			float lightDistance = length( lVector );
			light.color = spotLight.color * spotAttenuation;
			light.color *= getDistanceAttenuation( lightDistance, spotLight.distance, spotLight.decay );
			light.visible = ( light.color != vec3( 0.0 ) );
		} else {
			light.color = vec3( 0.0 );
			light.visible = false;
		}
	}
#endif
#if NUM_RECT_AREA_LIGHTS > 0
	struct RectAreaLight {
		vec3 color;
		vec3 position;
		vec3 halfWidth;
		vec3 halfHeight;
	};
	uniform sampler2D ltc_1;	uniform sampler2D ltc_2;
	uniform RectAreaLight rectAreaLights[ NUM_RECT_AREA_LIGHTS ];
#endif
#if NUM_HEMI_LIGHTS > 0
	struct HemisphereLight {
		vec3 direction;
		vec3 skyColor;
		vec3 groundColor;
	};
	uniform HemisphereLight hemisphereLights[ NUM_HEMI_LIGHTS ];
	vec3 getHemisphereLightIrradiance( const in HemisphereLight hemiLight, const in vec3 normal ) {
		float dotNL = dot( normal, hemiLight.direction );
		float hemiDiffuseWeight = 0.5 * dotNL + 0.5;
		vec3 irradiance = mix( hemiLight.groundColor, hemiLight.skyColor, hemiDiffuseWeight );
		return irradiance;
	}
#endif
#include <lightprobes_pars_fragment>`,D_=`#ifdef USE_ENVMAP
	vec3 getIBLIrradiance( const in vec3 normal ) {
		#ifdef ENVMAP_TYPE_PMREM
			vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
			vec4 envMapColor = textureLod( envMap, envMapRotation * worldNormal, ENVMAP_MAX_LOD );
			return PI * envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	vec3 getIBLRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness ) {
		#ifdef ENVMAP_TYPE_PMREM
			vec3 reflectVec = reflect( - viewDir, normal );
			reflectVec = normalize( mix( reflectVec, normal, pow4( roughness ) ) );
			reflectVec = transformDirectionByInverseViewMatrix( reflectVec, viewMatrix );
			vec4 envMapColor = textureLod( envMap, envMapRotation * reflectVec, roughnessToMip( roughness ) );
			return envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	#ifdef USE_RETROREFLECTION
		vec3 getIBLRetroRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness ) {
			#ifdef ENVMAP_TYPE_PMREM
				vec3 retroVec = normalize( mix( viewDir, normal, pow4( roughness ) ) );
				retroVec = transformDirectionByInverseViewMatrix( retroVec, viewMatrix );
				vec4 envMapColor = textureLod( envMap, envMapRotation * retroVec, roughnessToMip( roughness ) );
				return envMapColor.rgb * envMapIntensity;
			#else
				return vec3( 0.0 );
			#endif
		}
	#endif
	#ifdef USE_ANISOTROPY
		vec3 getIBLAnisotropyRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness, const in vec3 bitangent, const in float anisotropy ) {
			#ifdef ENVMAP_TYPE_PMREM
				vec3 bentNormal = cross( bitangent, viewDir );
				bentNormal = normalize( cross( bentNormal, bitangent ) );
				bentNormal = normalize( mix( bentNormal, normal, pow2( pow2( 1.0 - anisotropy * ( 1.0 - roughness ) ) ) ) );
				return getIBLRadiance( viewDir, bentNormal, roughness );
			#else
				return vec3( 0.0 );
			#endif
		}
		#ifdef USE_RETROREFLECTION
			vec3 getIBLAnisotropyRetroRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness, const in vec3 bitangent, const in float anisotropy ) {
				#ifdef ENVMAP_TYPE_PMREM
					vec3 bentNormal = cross( bitangent, viewDir );
					bentNormal = normalize( cross( bentNormal, bitangent ) );
					bentNormal = normalize( mix( bentNormal, normal, pow2( pow2( 1.0 - anisotropy * ( 1.0 - roughness ) ) ) ) );
					return getIBLRetroRadiance( viewDir, bentNormal, roughness );
				#else
					return vec3( 0.0 );
				#endif
			}
		#endif
	#endif
#endif`,O_=`ToonMaterial material;
material.diffuseColor = diffuseColor.rgb;`,U_=`varying vec3 vViewPosition;
struct ToonMaterial {
	vec3 diffuseColor;
};
void RE_Direct_Toon( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in ToonMaterial material, inout ReflectedLight reflectedLight ) {
	vec3 irradiance = getGradientIrradiance( geometryNormal, directLight.direction ) * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Toon( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in ToonMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_Toon
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Toon`,F_=`BlinnPhongMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularColor = specular;
material.specularShininess = shininess;
material.specularStrength = specularStrength;`,B_=`varying vec3 vViewPosition;
struct BlinnPhongMaterial {
	vec3 diffuseColor;
	vec3 specularColor;
	float specularShininess;
	float specularStrength;
};
void RE_Direct_BlinnPhong( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in BlinnPhongMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
	reflectedLight.directSpecular += irradiance * BRDF_BlinnPhong( directLight.direction, geometryViewDir, geometryNormal, material.specularColor, material.specularShininess ) * material.specularStrength;
}
void RE_IndirectDiffuse_BlinnPhong( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in BlinnPhongMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_BlinnPhong
#define RE_IndirectDiffuse		RE_IndirectDiffuse_BlinnPhong`,k_=`PhysicalMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.diffuseContribution = diffuseColor.rgb * ( 1.0 - metalnessFactor );
material.metalness = metalnessFactor;
vec3 dxy = max( abs( dFdx( nonPerturbedNormal ) ), abs( dFdy( nonPerturbedNormal ) ) );
float geometryRoughness = max( max( dxy.x, dxy.y ), dxy.z );
material.roughness = max( roughnessFactor, 0.045 );
material.roughness += geometryRoughness;
material.roughness = min( material.roughness, 1.0 );
#ifdef USE_DIFFUSE_ROUGHNESS
	float diffuseRoughnessFactor = diffuseRoughness;
	#ifdef USE_DIFFUSE_ROUGHNESSMAP
		diffuseRoughnessFactor *= texture2D( diffuseRoughnessMap, vDiffuseRoughnessMapUv ).r;
	#endif
	material.diffuseRoughness = saturate( diffuseRoughnessFactor );
#endif
#ifdef IOR
	material.ior = ior;
	#ifdef USE_SPECULAR
		float specularIntensityFactor = specularIntensity;
		vec3 specularColorFactor = specularColor;
		#ifdef USE_SPECULAR_COLORMAP
			specularColorFactor *= texture2D( specularColorMap, vSpecularColorMapUv ).rgb;
		#endif
		#ifdef USE_SPECULAR_INTENSITYMAP
			specularIntensityFactor *= texture2D( specularIntensityMap, vSpecularIntensityMapUv ).a;
		#endif
		material.specularF90 = mix( specularIntensityFactor, 1.0, metalnessFactor );
	#else
		float specularIntensityFactor = 1.0;
		vec3 specularColorFactor = vec3( 1.0 );
		material.specularF90 = 1.0;
	#endif
	material.specularColor = min( pow2( ( material.ior - 1.0 ) / ( material.ior + 1.0 ) ) * specularColorFactor, vec3( 1.0 ) ) * specularIntensityFactor;
	material.specularColorBlended = mix( material.specularColor, diffuseColor.rgb, metalnessFactor );
#else
	material.specularColor = vec3( 0.04 );
	material.specularColorBlended = mix( material.specularColor, diffuseColor.rgb, metalnessFactor );
	material.specularF90 = 1.0;
#endif
#ifdef USE_CLEARCOAT
	material.clearcoat = clearcoat;
	material.clearcoatRoughness = clearcoatRoughness;
	material.clearcoatF0 = vec3( 0.04 );
	material.clearcoatF90 = 1.0;
	#ifdef USE_CLEARCOATMAP
		material.clearcoat *= texture2D( clearcoatMap, vClearcoatMapUv ).x;
	#endif
	#ifdef USE_CLEARCOAT_ROUGHNESSMAP
		material.clearcoatRoughness *= texture2D( clearcoatRoughnessMap, vClearcoatRoughnessMapUv ).y;
	#endif
	material.clearcoat = saturate( material.clearcoat );	material.clearcoatRoughness = max( material.clearcoatRoughness, 0.045 );
	material.clearcoatRoughness += geometryRoughness;
	material.clearcoatRoughness = min( material.clearcoatRoughness, 1.0 );
#endif
#ifdef USE_DISPERSION
	material.dispersion = dispersion;
#endif
#ifdef USE_RETROREFLECTION
	material.retroreflectivity = retroreflectivity;
#endif
#ifdef USE_IRIDESCENCE
	material.iridescence = iridescence;
	material.iridescenceIOR = iridescenceIOR;
	#ifdef USE_IRIDESCENCEMAP
		material.iridescence *= texture2D( iridescenceMap, vIridescenceMapUv ).r;
	#endif
	#ifdef USE_IRIDESCENCE_THICKNESSMAP
		material.iridescenceThickness = (iridescenceThicknessMaximum - iridescenceThicknessMinimum) * texture2D( iridescenceThicknessMap, vIridescenceThicknessMapUv ).g + iridescenceThicknessMinimum;
	#else
		material.iridescenceThickness = iridescenceThicknessMaximum;
	#endif
#endif
#ifdef USE_SHEEN
	material.sheenColor = sheenColor;
	#ifdef USE_SHEEN_COLORMAP
		material.sheenColor *= texture2D( sheenColorMap, vSheenColorMapUv ).rgb;
	#endif
	material.sheenRoughness = clamp( sheenRoughness, 0.0001, 1.0 );
	#ifdef USE_SHEEN_ROUGHNESSMAP
		material.sheenRoughness *= texture2D( sheenRoughnessMap, vSheenRoughnessMapUv ).a;
	#endif
#endif
#ifdef USE_ANISOTROPY
	#ifdef USE_ANISOTROPYMAP
		mat2 anisotropyMat = mat2( anisotropyVector.x, anisotropyVector.y, - anisotropyVector.y, anisotropyVector.x );
		vec3 anisotropyPolar = texture2D( anisotropyMap, vAnisotropyMapUv ).rgb;
		vec2 anisotropyV = anisotropyMat * normalize( 2.0 * anisotropyPolar.rg - vec2( 1.0 ) ) * anisotropyPolar.b;
	#else
		vec2 anisotropyV = anisotropyVector;
	#endif
	material.anisotropy = length( anisotropyV );
	if( material.anisotropy == 0.0 ) {
		anisotropyV = vec2( 1.0, 0.0 );
	} else {
		anisotropyV /= material.anisotropy;
		material.anisotropy = saturate( material.anisotropy );
	}
	material.alphaT = mix( pow2( material.roughness ), 1.0, pow2( material.anisotropy ) );
	material.anisotropyT = tbn[ 0 ] * anisotropyV.x + tbn[ 1 ] * anisotropyV.y;
	material.anisotropyB = tbn[ 1 ] * anisotropyV.x - tbn[ 0 ] * anisotropyV.y;
#endif`,z_=`uniform sampler2D dfgLUT;
struct PhysicalMaterial {
	vec3 diffuseColor;
	vec3 diffuseContribution;
	vec3 specularColor;
	vec3 specularColorBlended;
	float roughness;
	float metalness;
	float specularF90;
	float dispersion;
	vec2 dfg;
	vec3 multiScatteringCompensation;
	#ifdef USE_DIFFUSE_ROUGHNESS
		float diffuseRoughness;
	#endif
	#ifdef USE_RETROREFLECTION
		float retroreflectivity;
	#endif
	#ifdef USE_CLEARCOAT
		float clearcoat;
		float clearcoatRoughness;
		vec3 clearcoatF0;
		float clearcoatF90;
	#endif
	#ifdef USE_IRIDESCENCE
		float iridescence;
		float iridescenceIOR;
		float iridescenceThickness;
		vec3 iridescenceFresnel;
		vec3 iridescenceF0Dielectric;
		vec3 iridescenceF0Metallic;
	#endif
	#ifdef USE_SHEEN
		vec3 sheenColor;
		float sheenRoughness;
	#endif
	#ifdef IOR
		float ior;
	#endif
	#ifdef USE_TRANSMISSION
		float transmission;
		float transmissionAlpha;
		float thickness;
		float attenuationDistance;
		vec3 attenuationColor;
	#endif
	#ifdef USE_ANISOTROPY
		float anisotropy;
		float alphaT;
		vec3 anisotropyT;
		vec3 anisotropyB;
	#endif
};
vec3 clearcoatSpecularDirect = vec3( 0.0 );
vec3 clearcoatSpecularIndirect = vec3( 0.0 );
vec3 sheenSpecularDirect = vec3( 0.0 );
vec3 sheenSpecularIndirect = vec3(0.0 );
vec3 Schlick_to_F0( const in vec3 f, const in float f90, const in float dotVH ) {
    float x = clamp( 1.0 - dotVH, 0.0, 1.0 );
    float x2 = x * x;
    float x5 = clamp( x * x2 * x2, 0.0, 0.9999 );
    return ( f - vec3( f90 ) * x5 ) / ( 1.0 - x5 );
}
#ifdef USE_DIFFUSE_ROUGHNESS
	const float EON_EPSILON = 1e-7;
	float FON_DirectionalAlbedo( const in float mu, const in float roughness, const in float A ) {
		float muComp = 1.0 - mu;
		float gOverPi = muComp * ( 0.0571085289 + muComp * ( 0.491881867 + muComp * ( - 0.332181442 + muComp * 0.0714429953 ) ) );
		return A * ( 1.0 + roughness * gOverPi );
	}
	vec3 BRDF_EON( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in vec3 diffuseColor, const in float roughness ) {
		vec3 rho = saturate( diffuseColor );
		if ( roughness <= EON_EPSILON ) return BRDF_Lambert( rho );
		float dotNL = saturate( dot( normal, lightDir ) );
		float dotNV = saturate( dot( normal, viewDir ) );
		float s = dot( lightDir, viewDir ) - dotNL * dotNV;
		float sOverT = ( s > 0.0 ) ? s / max( max( dotNL, dotNV ), EON_EPSILON ) : s;
		float A = 1.0 / ( 1.0 + ( 0.5 - 2.0 / ( 3.0 * PI ) ) * roughness );
		vec3 singleScatter = rho * RECIPROCAL_PI * A * ( 1.0 + roughness * sOverT );
		float averageAlbedo = A * ( 1.0 + ( 2.0 / 3.0 - 28.0 / ( 15.0 * PI ) ) * roughness );
		float albedoV = FON_DirectionalAlbedo( dotNV, roughness, A );
		float albedoL = FON_DirectionalAlbedo( dotNL, roughness, A );
		vec3 rhoMultiScatter = rho * rho * averageAlbedo / max( vec3( EON_EPSILON ), vec3( 1.0 ) - rho * ( 1.0 - averageAlbedo ) );
		vec3 multiScatter = rhoMultiScatter * RECIPROCAL_PI
			* max( EON_EPSILON, 1.0 - albedoV )
			* max( EON_EPSILON, 1.0 - albedoL )
			/ max( EON_EPSILON, 1.0 - averageAlbedo );
		return singleScatter + multiScatter;
	}
	vec3 EON_DirectionalAlbedo( const in vec3 diffuseColor, const in float roughness, const in float dotNV ) {
		vec3 rho = saturate( diffuseColor );
		if ( roughness <= EON_EPSILON ) return rho;
		float A = 1.0 / ( 1.0 + ( 0.5 - 2.0 / ( 3.0 * PI ) ) * roughness );
		float directionalAlbedo = FON_DirectionalAlbedo( dotNV, roughness, A );
		float averageAlbedo = A * ( 1.0 + ( 2.0 / 3.0 - 28.0 / ( 15.0 * PI ) ) * roughness );
		vec3 rhoMultiScatter = rho * rho * averageAlbedo / max( vec3( EON_EPSILON ), vec3( 1.0 ) - rho * ( 1.0 - averageAlbedo ) );
		return rho * directionalAlbedo + rhoMultiScatter * ( 1.0 - directionalAlbedo );
	}
#endif
float V_GGX_SmithCorrelated( const in float alpha, const in float dotNL, const in float dotNV ) {
	float a2 = pow2( alpha );
	float gv = dotNL * sqrt( a2 + ( 1.0 - a2 ) * pow2( dotNV ) );
	float gl = dotNV * sqrt( a2 + ( 1.0 - a2 ) * pow2( dotNL ) );
	return 0.5 / max( gv + gl, EPSILON );
}
float D_GGX( const in float alpha, const in float dotNH ) {
	float a2 = pow2( alpha );
	float denom = pow2( dotNH ) * ( a2 - 1.0 ) + 1.0;
	return RECIPROCAL_PI * a2 / pow2( denom );
}
#ifdef USE_ANISOTROPY
	float V_GGX_SmithCorrelated_Anisotropic( const in float alphaT, const in float alphaB, const in float dotTV, const in float dotBV, const in float dotTL, const in float dotBL, const in float dotNV, const in float dotNL ) {
		float gv = dotNL * length( vec3( alphaT * dotTV, alphaB * dotBV, dotNV ) );
		float gl = dotNV * length( vec3( alphaT * dotTL, alphaB * dotBL, dotNL ) );
		return 0.5 / max( gv + gl, EPSILON );
	}
	float D_GGX_Anisotropic( const in float alphaT, const in float alphaB, const in float dotNH, const in float dotTH, const in float dotBH ) {
		float a2 = alphaT * alphaB;
		highp vec3 v = vec3( alphaB * dotTH, alphaT * dotBH, a2 * dotNH );
		highp float v2 = dot( v, v );
		float w2 = a2 / v2;
		return RECIPROCAL_PI * a2 * pow2 ( w2 );
	}
#endif
#ifdef USE_CLEARCOAT
	vec3 BRDF_GGX_Clearcoat( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in PhysicalMaterial material) {
		vec3 f0 = material.clearcoatF0;
		float f90 = material.clearcoatF90;
		float roughness = max( material.clearcoatRoughness, 0.045 );
		float alpha = pow2( roughness );
		vec3 halfDir = normalize( lightDir + viewDir );
		float dotNL = saturate( dot( normal, lightDir ) );
		float dotNV = saturate( dot( normal, viewDir ) );
		float dotNH = saturate( dot( normal, halfDir ) );
		float dotVH = saturate( dot( viewDir, halfDir ) );
		vec3 F = F_Schlick( f0, f90, dotVH );
		float V = V_GGX_SmithCorrelated( alpha, dotNL, dotNV );
		float D = D_GGX( alpha, dotNH );
		return F * ( V * D );
	}
#endif
vec3 BRDF_GGX( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in PhysicalMaterial material ) {
	vec3 f0 = material.specularColorBlended;
	float f90 = material.specularF90;
	float roughness = max( material.roughness, 0.045 );
	float alpha = pow2( roughness );
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNL = saturate( dot( normal, lightDir ) );
	float dotNV = saturate( dot( normal, viewDir ) );
	float dotNH = saturate( dot( normal, halfDir ) );
	float dotVH = saturate( dot( viewDir, halfDir ) );
	vec3 F = F_Schlick( f0, f90, dotVH );
	#ifdef USE_IRIDESCENCE
		F = mix( F, material.iridescenceFresnel, material.iridescence );
	#endif
	#ifdef USE_ANISOTROPY
		float dotTL = dot( material.anisotropyT, lightDir );
		float dotTV = dot( material.anisotropyT, viewDir );
		float dotTH = dot( material.anisotropyT, halfDir );
		float dotBL = dot( material.anisotropyB, lightDir );
		float dotBV = dot( material.anisotropyB, viewDir );
		float dotBH = dot( material.anisotropyB, halfDir );
		float alphaT = max( material.alphaT, alpha );
		float V = V_GGX_SmithCorrelated_Anisotropic( alphaT, alpha, dotTV, dotBV, dotTL, dotBL, dotNV, dotNL );
		float D = D_GGX_Anisotropic( alphaT, alpha, dotNH, dotTH, dotBH );
	#else
		float V = V_GGX_SmithCorrelated( alpha, dotNL, dotNV );
		float D = D_GGX( alpha, dotNH );
	#endif
	return F * ( V * D );
}
vec2 LTC_Uv( const in vec3 N, const in vec3 V, const in float roughness ) {
	const float LUT_SIZE = 64.0;
	const float LUT_SCALE = ( LUT_SIZE - 1.0 ) / LUT_SIZE;
	const float LUT_BIAS = 0.5 / LUT_SIZE;
	float dotNV = saturate( dot( N, V ) );
	vec2 uv = vec2( roughness, sqrt( 1.0 - dotNV ) );
	uv = uv * LUT_SCALE + LUT_BIAS;
	return uv;
}
float LTC_ClippedSphereFormFactor( const in vec3 f ) {
	float l = length( f );
	return max( ( l * l + f.z ) / ( l + 1.0 ), 0.0 );
}
vec3 LTC_EdgeVectorFormFactor( const in vec3 v1, const in vec3 v2 ) {
	float x = dot( v1, v2 );
	float y = abs( x );
	float a = 0.8543985 + ( 0.4965155 + 0.0145206 * y ) * y;
	float b = 3.4175940 + ( 4.1616724 + y ) * y;
	float v = a / b;
	float theta_sintheta = ( x > 0.0 ) ? v : 0.5 * inversesqrt( max( 1.0 - x * x, 1e-7 ) ) - v;
	return cross( v1, v2 ) * theta_sintheta;
}
vec3 LTC_Evaluate( const in vec3 N, const in vec3 V, const in vec3 P, const in mat3 mInv, const in vec3 rectCoords[ 4 ] ) {
	vec3 v1 = rectCoords[ 1 ] - rectCoords[ 0 ];
	vec3 v2 = rectCoords[ 3 ] - rectCoords[ 0 ];
	vec3 lightNormal = cross( v1, v2 );
	if( dot( lightNormal, P - rectCoords[ 0 ] ) < 0.0 ) return vec3( 0.0 );
	vec3 T1, T2;
	T1 = normalize( V - N * dot( V, N ) );
	T2 = - cross( N, T1 );
	mat3 mat = mInv * transpose( mat3( T1, T2, N ) );
	vec3 coords[ 4 ];
	coords[ 0 ] = mat * ( rectCoords[ 0 ] - P );
	coords[ 1 ] = mat * ( rectCoords[ 1 ] - P );
	coords[ 2 ] = mat * ( rectCoords[ 2 ] - P );
	coords[ 3 ] = mat * ( rectCoords[ 3 ] - P );
	coords[ 0 ] = normalize( coords[ 0 ] );
	coords[ 1 ] = normalize( coords[ 1 ] );
	coords[ 2 ] = normalize( coords[ 2 ] );
	coords[ 3 ] = normalize( coords[ 3 ] );
	vec3 vectorFormFactor = vec3( 0.0 );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 0 ], coords[ 1 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 1 ], coords[ 2 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 2 ], coords[ 3 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 3 ], coords[ 0 ] );
	float result = LTC_ClippedSphereFormFactor( vectorFormFactor );
	return vec3( result );
}
#if defined( USE_SHEEN )
float D_Charlie( float roughness, float dotNH ) {
	float alpha = pow2( roughness );
	float invAlpha = 1.0 / alpha;
	float cos2h = dotNH * dotNH;
	float sin2h = max( 1.0 - cos2h, 0.0078125 );
	return ( 2.0 + invAlpha ) * pow( sin2h, invAlpha * 0.5 ) / ( 2.0 * PI );
}
float V_Neubelt( float dotNV, float dotNL ) {
	return saturate( 1.0 / ( 4.0 * ( dotNL + dotNV - dotNL * dotNV ) ) );
}
vec3 BRDF_Sheen( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, vec3 sheenColor, const in float sheenRoughness ) {
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNL = saturate( dot( normal, lightDir ) );
	float dotNV = saturate( dot( normal, viewDir ) );
	float dotNH = saturate( dot( normal, halfDir ) );
	float D = D_Charlie( sheenRoughness, dotNH );
	float V = V_Neubelt( dotNV, dotNL );
	return sheenColor * ( D * V );
}
#endif
float IBLSheenBRDF( const in vec3 normal, const in vec3 viewDir, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	float r2 = roughness * roughness;
	float rInv = 1.0 / ( roughness + 0.1 );
	float a = -1.9362 + 1.0678 * roughness + 0.4573 * r2 - 0.8469 * rInv;
	float b = -0.6014 + 0.5538 * roughness - 0.4670 * r2 - 0.1255 * rInv;
	float DG = exp( a * dotNV + b );
	return saturate( DG );
}
vec3 EnvironmentBRDF( const in vec3 normal, const in vec3 viewDir, const in vec3 specularColor, const in float specularF90, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	vec2 fab = texture2D( dfgLUT, vec2( roughness, dotNV ) ).rg;
	return specularColor * fab.x + specularF90 * fab.y;
}
#ifdef USE_IRIDESCENCE
void computeMultiscatteringIridescence( const in vec2 fab, const in vec3 specularColor, const in float specularF90, const in float iridescence, const in vec3 iridescenceF0, inout vec3 singleScatter, inout vec3 multiScatter ) {
#else
void computeMultiscattering( const in vec2 fab, const in vec3 specularColor, const in float specularF90, inout vec3 singleScatter, inout vec3 multiScatter ) {
#endif
	#ifdef USE_IRIDESCENCE
		vec3 Fr = mix( specularColor, iridescenceF0, iridescence );
	#else
		vec3 Fr = specularColor;
	#endif
	vec3 FssEss = Fr * fab.x + specularF90 * fab.y;
	float Ess = fab.x + fab.y;
	float Ems = 1.0 - Ess;
	vec3 Favg = Fr + ( 1.0 - Fr ) * 0.047619;	vec3 Fms = FssEss * Favg / ( 1.0 - Ems * Favg );
	singleScatter += FssEss;
	multiScatter += Fms * Ems;
}
#if NUM_RECT_AREA_LIGHTS > 0
	void RE_Direct_RectArea_Physical( const in RectAreaLight rectAreaLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
		vec3 normal = geometryNormal;
		vec3 viewDir = geometryViewDir;
		vec3 position = geometryPosition;
		vec3 lightPos = rectAreaLight.position;
		vec3 halfWidth = rectAreaLight.halfWidth;
		vec3 halfHeight = rectAreaLight.halfHeight;
		vec3 lightColor = rectAreaLight.color;
		float roughness = material.roughness;
		vec3 rectCoords[ 4 ];
		rectCoords[ 0 ] = lightPos + halfWidth - halfHeight;		rectCoords[ 1 ] = lightPos - halfWidth - halfHeight;
		rectCoords[ 2 ] = lightPos - halfWidth + halfHeight;
		rectCoords[ 3 ] = lightPos + halfWidth + halfHeight;
		vec2 uv = LTC_Uv( normal, viewDir, roughness );
		vec4 t1 = texture2D( ltc_1, uv );
		vec4 t2 = texture2D( ltc_2, uv );
		mat3 mInv = mat3(
			vec3( t1.x, 0, t1.y ),
			vec3(    0, 1,    0 ),
			vec3( t1.z, 0, t1.w )
		);
		vec3 fresnel = ( material.specularColorBlended * t2.x + ( material.specularF90 - material.specularColorBlended ) * t2.y );
		reflectedLight.directSpecular += lightColor * fresnel * LTC_Evaluate( normal, viewDir, position, mInv, rectCoords );
		reflectedLight.directDiffuse += lightColor * material.diffuseContribution * LTC_Evaluate( normal, viewDir, position, mat3( 1.0 ), rectCoords );
		#ifdef USE_CLEARCOAT
			vec3 Ncc = geometryClearcoatNormal;
			vec2 uvClearcoat = LTC_Uv( Ncc, viewDir, material.clearcoatRoughness );
			vec4 t1Clearcoat = texture2D( ltc_1, uvClearcoat );
			vec4 t2Clearcoat = texture2D( ltc_2, uvClearcoat );
			mat3 mInvClearcoat = mat3(
				vec3( t1Clearcoat.x, 0, t1Clearcoat.y ),
				vec3(             0, 1,             0 ),
				vec3( t1Clearcoat.z, 0, t1Clearcoat.w )
			);
			vec3 fresnelClearcoat = material.clearcoatF0 * t2Clearcoat.x + ( material.clearcoatF90 - material.clearcoatF0 ) * t2Clearcoat.y;
			clearcoatSpecularDirect += lightColor * fresnelClearcoat * LTC_Evaluate( Ncc, viewDir, position, mInvClearcoat, rectCoords );
		#endif
	}
#endif
void RE_Direct_Physical( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	#ifdef USE_CLEARCOAT
		float dotNLcc = saturate( dot( geometryClearcoatNormal, directLight.direction ) );
		vec3 ccIrradiance = dotNLcc * directLight.color;
		clearcoatSpecularDirect += ccIrradiance * BRDF_GGX_Clearcoat( directLight.direction, geometryViewDir, geometryClearcoatNormal, material );
	#endif
	#ifdef USE_SHEEN
 
 		sheenSpecularDirect += irradiance * BRDF_Sheen( directLight.direction, geometryViewDir, geometryNormal, material.sheenColor, material.sheenRoughness );
 
 		float sheenAlbedoV = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
 		float sheenAlbedoL = IBLSheenBRDF( geometryNormal, directLight.direction, material.sheenRoughness );
 
 		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * max( sheenAlbedoV, sheenAlbedoL );
 
 		irradiance *= sheenEnergyComp;
 
 	#endif
	vec3 specularBRDF = BRDF_GGX( directLight.direction, geometryViewDir, geometryNormal, material );
	#ifdef USE_RETROREFLECTION
		vec3 retroViewDir = reflect( - geometryViewDir, geometryNormal );
		vec3 retroSpecularBRDF = BRDF_GGX( directLight.direction, retroViewDir, geometryNormal, material );
		specularBRDF = mix( specularBRDF, retroSpecularBRDF, saturate( material.retroreflectivity ) );
	#endif
	reflectedLight.directSpecular += irradiance * specularBRDF * material.multiScatteringCompensation;
	vec3 halfDir = normalize( directLight.direction + geometryViewDir );
	float dotVH = saturate( dot( geometryViewDir, halfDir ) );
	vec3 F = F_Schlick( material.specularColor, material.specularF90, dotVH );
	#ifdef USE_RETROREFLECTION
		vec3 retroHalfDir = normalize( directLight.direction + retroViewDir );
		float dotRetroVH = saturate( dot( retroViewDir, retroHalfDir ) );
		vec3 retroF = F_Schlick( material.specularColor, material.specularF90, dotRetroVH );
		F = mix( F, retroF, saturate( material.retroreflectivity ) );
	#endif
	#ifdef USE_DIFFUSE_ROUGHNESS
		vec3 diffuseBRDF = BRDF_EON( directLight.direction, geometryViewDir, geometryNormal, material.diffuseColor, material.diffuseRoughness ) * ( 1.0 - material.metalness );
	#else
		vec3 diffuseBRDF = BRDF_Lambert( material.diffuseContribution );
	#endif
	reflectedLight.directDiffuse += irradiance * diffuseBRDF * ( 1.0 - F );
}
void RE_IndirectDiffuse_Physical( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	vec3 singleScattering = vec3( 0.0 );
	vec3 multiScattering = vec3( 0.0 );
	#ifdef USE_IRIDESCENCE
		computeMultiscatteringIridescence( material.dfg, material.specularColor, material.specularF90, material.iridescence, material.iridescenceF0Dielectric, singleScattering, multiScattering );
	#else
		computeMultiscattering( material.dfg, material.specularColor, material.specularF90, singleScattering, multiScattering );
	#endif
	#ifdef USE_DIFFUSE_ROUGHNESS
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		vec3 diffuseAlbedo = EON_DirectionalAlbedo( material.diffuseColor, material.diffuseRoughness, dotNV ) * ( 1.0 - material.metalness );
		vec3 diffuse = irradiance * RECIPROCAL_PI * diffuseAlbedo * ( 1.0 - singleScattering - multiScattering );
	#else
		vec3 diffuse = irradiance * BRDF_Lambert( material.diffuseContribution ) * ( 1.0 - singleScattering - multiScattering );
	#endif
	#ifdef USE_SHEEN
		float sheenAlbedo = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
		sheenSpecularIndirect += irradiance * material.sheenColor * sheenAlbedo * RECIPROCAL_PI;
		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * sheenAlbedo;
		diffuse *= sheenEnergyComp;
	#endif
	reflectedLight.indirectDiffuse += diffuse;
}
void RE_IndirectSpecular_Physical( const in vec3 radiance, const in vec3 irradiance, const in vec3 clearcoatRadiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight) {
	#ifdef USE_CLEARCOAT
		clearcoatSpecularIndirect += clearcoatRadiance * EnvironmentBRDF( geometryClearcoatNormal, geometryViewDir, material.clearcoatF0, material.clearcoatF90, material.clearcoatRoughness );
	#endif
	#ifdef USE_SHEEN
		sheenSpecularIndirect += irradiance * material.sheenColor * IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness ) * RECIPROCAL_PI;
 	#endif
	vec3 singleScatteringDielectric = vec3( 0.0 );
	vec3 multiScatteringDielectric = vec3( 0.0 );
	vec3 singleScatteringMetallic = vec3( 0.0 );
	vec3 multiScatteringMetallic = vec3( 0.0 );
	#ifdef USE_IRIDESCENCE
		computeMultiscatteringIridescence( material.dfg, material.specularColor, material.specularF90, material.iridescence, material.iridescenceF0Dielectric, singleScatteringDielectric, multiScatteringDielectric );
		computeMultiscatteringIridescence( material.dfg, material.diffuseColor, material.specularF90, material.iridescence, material.iridescenceF0Metallic, singleScatteringMetallic, multiScatteringMetallic );
	#else
		computeMultiscattering( material.dfg, material.specularColor, material.specularF90, singleScatteringDielectric, multiScatteringDielectric );
		computeMultiscattering( material.dfg, material.diffuseColor, material.specularF90, singleScatteringMetallic, multiScatteringMetallic );
	#endif
	vec3 singleScattering = mix( singleScatteringDielectric, singleScatteringMetallic, material.metalness );
	vec3 multiScattering = mix( multiScatteringDielectric, multiScatteringMetallic, material.metalness );
	vec3 totalScatteringDielectric = singleScatteringDielectric + multiScatteringDielectric;
	#ifdef USE_DIFFUSE_ROUGHNESS
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		vec3 diffuse = EON_DirectionalAlbedo( material.diffuseColor, material.diffuseRoughness, dotNV ) * ( 1.0 - material.metalness ) * ( 1.0 - totalScatteringDielectric );
	#else
		vec3 diffuse = material.diffuseContribution * ( 1.0 - totalScatteringDielectric );
	#endif
	vec3 cosineWeightedIrradiance = irradiance * RECIPROCAL_PI;
	vec3 indirectSpecular = radiance * singleScattering;
	indirectSpecular += multiScattering * cosineWeightedIrradiance;
	vec3 indirectDiffuse = diffuse * cosineWeightedIrradiance;
	#ifdef USE_SHEEN
		float sheenAlbedo = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * sheenAlbedo;
		indirectSpecular *= sheenEnergyComp;
		indirectDiffuse *= sheenEnergyComp;
	#endif
	reflectedLight.indirectSpecular += indirectSpecular;
	reflectedLight.indirectDiffuse += indirectDiffuse;
}
#define RE_Direct				RE_Direct_Physical
#define RE_Direct_RectArea		RE_Direct_RectArea_Physical
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Physical
#define RE_IndirectSpecular		RE_IndirectSpecular_Physical
float computeSpecularOcclusion( const in float dotNV, const in float ambientOcclusion, const in float roughness ) {
	return saturate( pow( dotNV + ambientOcclusion, exp2( - 16.0 * roughness - 1.0 ) ) - 1.0 + ambientOcclusion );
}`,V_=`
vec3 geometryPosition = - vViewPosition;
vec3 geometryNormal = normal;
vec3 geometryViewDir = ( isOrthographic ) ? vec3( 0, 0, 1 ) : normalize( vViewPosition );
vec3 geometryClearcoatNormal = vec3( 0.0 );
#ifdef USE_CLEARCOAT
	geometryClearcoatNormal = clearcoatNormal;
#endif
#ifdef USE_IRIDESCENCE
	float dotNVi = saturate( dot( normal, geometryViewDir ) );
	if ( material.iridescenceThickness == 0.0 ) {
		material.iridescence = 0.0;
	} else {
		material.iridescence = saturate( material.iridescence );
	}
	if ( material.iridescence > 0.0 ) {
		vec3 iridescenceFresnelDielectric = evalIridescence( 1.0, material.iridescenceIOR, dotNVi, material.iridescenceThickness, material.specularColor );
		vec3 iridescenceFresnelMetallic = evalIridescence( 1.0, material.iridescenceIOR, dotNVi, material.iridescenceThickness, material.diffuseColor );
		material.iridescenceFresnel = mix( iridescenceFresnelDielectric, iridescenceFresnelMetallic, material.metalness );
		material.iridescenceF0Dielectric = Schlick_to_F0( iridescenceFresnelDielectric, 1.0, dotNVi );
		material.iridescenceF0Metallic = Schlick_to_F0( iridescenceFresnelMetallic, 1.0, dotNVi );
	}
#endif
#ifdef STANDARD
	float dotNVms = saturate( dot( geometryNormal, geometryViewDir ) );
	material.dfg = texture2D( dfgLUT, vec2( material.roughness, dotNVms ) ).rg;
	#if ( NUM_SUN_LIGHTS > 0 || NUM_DIR_LIGHTS > 0 || NUM_POINT_LIGHTS > 0 || NUM_SPOT_LIGHTS > 0 )
		float EssMs = material.dfg.x + material.dfg.y;
		material.multiScatteringCompensation = 1.0 + material.specularColorBlended * ( 1.0 / EssMs - 1.0 );
	#endif
#endif
IncidentLight directLight;
#if ( NUM_POINT_LIGHTS > 0 ) && defined( RE_Direct )
	PointLight pointLight;
	#if defined( USE_SHADOWMAP ) && NUM_POINT_LIGHT_SHADOWS > 0
	PointLightShadow pointLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHTS; i ++ ) {
		pointLight = pointLights[ i ];
		getPointLightInfo( pointLight, geometryPosition, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_POINT_LIGHT_SHADOWS ) && ( defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_BASIC ) )
		pointLightShadow = pointLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getPointShadow( pointShadowMap[ i ], pointLightShadow.shadowMapSize, pointLightShadow.shadowIntensity, pointLightShadow.shadowBias, pointLightShadow.shadowRadius, vPointShadowCoord[ i ], pointLightShadow.shadowCameraNear, pointLightShadow.shadowCameraFar ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_SPOT_LIGHTS > 0 ) && defined( RE_Direct )
	SpotLight spotLight;
	vec4 spotColor;
	vec3 spotLightCoord;
	bool inSpotLightMap;
	#if defined( USE_SHADOWMAP ) && NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHTS; i ++ ) {
		spotLight = spotLights[ i ];
		getSpotLightInfo( spotLight, geometryPosition, directLight );
		#if ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
		#define SPOT_LIGHT_MAP_INDEX UNROLLED_LOOP_INDEX
		#elif ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
		#define SPOT_LIGHT_MAP_INDEX NUM_SPOT_LIGHT_MAPS
		#else
		#define SPOT_LIGHT_MAP_INDEX ( UNROLLED_LOOP_INDEX - NUM_SPOT_LIGHT_SHADOWS + NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
		#endif
		#if ( SPOT_LIGHT_MAP_INDEX < NUM_SPOT_LIGHT_MAPS )
			spotLightCoord = vSpotLightCoord[ i ].xyz / vSpotLightCoord[ i ].w;
			inSpotLightMap = all( lessThan( abs( spotLightCoord * 2. - 1. ), vec3( 1.0 ) ) );
			spotColor = texture2D( spotLightMap[ SPOT_LIGHT_MAP_INDEX ], spotLightCoord.xy );
			directLight.color = inSpotLightMap ? directLight.color * spotColor.rgb : directLight.color;
		#endif
		#undef SPOT_LIGHT_MAP_INDEX
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
		spotLightShadow = spotLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( spotShadowMap[ i ], spotLightShadow.shadowMapSize, spotLightShadow.shadowIntensity, spotLightShadow.shadowBias, spotLightShadow.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_SUN_LIGHTS > 0 ) && defined( RE_Direct )
	SunLight sunLight;
	#if defined( USE_SHADOWMAP ) && NUM_SUN_LIGHT_SHADOWS > 0
	SunLightShadow sunLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SUN_LIGHTS; i ++ ) {
		sunLight = sunLights[ i ];
		getSunLightInfo( sunLight, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_SUN_LIGHT_SHADOWS )
		sunLightShadow = sunLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getSunShadow( sunShadowMap[ i ], sunLightShadow, UNROLLED_LOOP_INDEX ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_DIR_LIGHTS > 0 ) && defined( RE_Direct )
	DirectionalLight directionalLight;
	#if defined( USE_SHADOWMAP ) && NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHTS; i ++ ) {
		directionalLight = directionalLights[ i ];
		getDirectionalLightInfo( directionalLight, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_DIR_LIGHT_SHADOWS )
		directionalLightShadow = directionalLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( directionalShadowMap[ i ], directionalLightShadow.shadowMapSize, directionalLightShadow.shadowIntensity, directionalLightShadow.shadowBias, directionalLightShadow.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_RECT_AREA_LIGHTS > 0 ) && defined( RE_Direct_RectArea )
	RectAreaLight rectAreaLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_RECT_AREA_LIGHTS; i ++ ) {
		rectAreaLight = rectAreaLights[ i ];
		RE_Direct_RectArea( rectAreaLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if defined( RE_IndirectDiffuse )
	vec3 iblIrradiance = vec3( 0.0 );
	vec3 irradiance = getAmbientLightIrradiance( ambientLightColor );
	#if defined( USE_LIGHT_PROBES )
		irradiance += getLightProbeIrradiance( lightProbe, geometryNormal );
	#endif
	#if ( NUM_HEMI_LIGHTS > 0 )
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_HEMI_LIGHTS; i ++ ) {
			irradiance += getHemisphereLightIrradiance( hemisphereLights[ i ], geometryNormal );
		}
		#pragma unroll_loop_end
	#endif
	#if NUM_LIGHT_PROBE_GRIDS > 0
		vec3 probeWorldPos = ( ( vec4( geometryPosition, 1.0 ) - viewMatrix[ 3 ] ) * viewMatrix ).xyz;
		vec3 probeWorldNormal = transformNormalByInverseViewMatrix( geometryNormal, viewMatrix );
		int probeGrid = - 1;
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_LIGHT_PROBE_GRIDS; i ++ ) {
			if ( isInsideLightProbeGrid( probeWorldPos, probeWorldNormal, probesMin[ i ], probesMax[ i ], probesResolution[ i ] ) ) probeGrid = UNROLLED_LOOP_INDEX;
		}
		#pragma unroll_loop_end
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_LIGHT_PROBE_GRIDS; i ++ ) {
			if ( probeGrid == UNROLLED_LOOP_INDEX ) irradiance += getLightProbeGridIrradiance( probesSH[ i ], probesMin[ i ], probesMax[ i ], probesResolution[ i ], probeWorldPos, probeWorldNormal );
		}
		#pragma unroll_loop_end
	#endif
#endif
#if defined( RE_IndirectSpecular )
	vec3 radiance = vec3( 0.0 );
	vec3 clearcoatRadiance = vec3( 0.0 );
#endif`,G_=`#if defined( RE_IndirectDiffuse )
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		vec3 lightMapIrradiance = lightMapTexel.rgb * lightMapIntensity;
		irradiance += lightMapIrradiance;
	#endif
	#if defined( USE_ENVMAP ) && defined( ENVMAP_TYPE_PMREM )
		#if defined( STANDARD ) || defined( LAMBERT ) || defined( PHONG )
			iblIrradiance += getIBLIrradiance( geometryNormal );
		#endif
	#endif
#endif
#if defined( USE_ENVMAP ) && defined( RE_IndirectSpecular )
	#ifdef USE_ANISOTROPY
		vec3 iblRadiance = getIBLAnisotropyRadiance( geometryViewDir, geometryNormal, material.roughness, material.anisotropyB, material.anisotropy );
	#else
		vec3 iblRadiance = getIBLRadiance( geometryViewDir, geometryNormal, material.roughness );
	#endif
	#ifdef USE_RETROREFLECTION
		#ifdef USE_ANISOTROPY
			vec3 retroIBLRadiance = getIBLAnisotropyRetroRadiance( geometryViewDir, geometryNormal, material.roughness, material.anisotropyB, material.anisotropy );
		#else
			vec3 retroIBLRadiance = getIBLRetroRadiance( geometryViewDir, geometryNormal, material.roughness );
		#endif
		iblRadiance = mix( iblRadiance, retroIBLRadiance, saturate( material.retroreflectivity ) );
	#endif
	radiance += iblRadiance;
	#ifdef USE_CLEARCOAT
		clearcoatRadiance += getIBLRadiance( geometryViewDir, geometryClearcoatNormal, material.clearcoatRoughness );
	#endif
#endif`,H_=`#if defined( RE_IndirectDiffuse )
	#if defined( LAMBERT ) || defined( PHONG )
		irradiance += iblIrradiance;
	#endif
	RE_IndirectDiffuse( irradiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif
#if defined( RE_IndirectSpecular )
	RE_IndirectSpecular( radiance, iblIrradiance, clearcoatRadiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif`,W_=`#if NUM_LIGHT_PROBE_GRIDS > 0
uniform highp sampler3D probesSH[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesMin[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesMax[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesResolution[ NUM_LIGHT_PROBE_GRIDS ];
bool isInsideLightProbeGrid( vec3 worldPos, vec3 worldNormal, vec3 probesMin, vec3 probesMax, vec3 probesResolution ) {
	vec3 spacing = ( probesMax - probesMin ) / probesResolution;
	vec3 samplePos = worldPos + worldNormal * spacing * 0.5;
	vec3 margin = spacing * 0.01;
	return all( greaterThanEqual( samplePos, probesMin - margin ) ) && all( lessThanEqual( samplePos, probesMax + margin ) );
}
vec3 getLightProbeGridIrradiance( highp sampler3D probesSH, vec3 probesMin, vec3 probesMax, vec3 probesResolution, vec3 worldPos, vec3 worldNormal ) {
	vec3 res = probesResolution;
	vec3 gridRange = probesMax - probesMin;
	vec3 probeSpacing = gridRange / res;
	vec3 samplePos = worldPos + worldNormal * probeSpacing * 0.5;
	vec3 uvw = clamp( ( samplePos - probesMin ) / gridRange, 0.5 / res, 1.0 - 0.5 / res );
	float nz          = res.z;
	float paddedSlices = nz + 2.0;
	float atlasDepth  = 7.0 * paddedSlices;
	float uvZBase     = uvw.z * nz + 1.0;
	vec4 s0 = texture( probesSH, vec3( uvw.xy, ( uvZBase                       ) / atlasDepth ) );
	vec4 s1 = texture( probesSH, vec3( uvw.xy, ( uvZBase +       paddedSlices   ) / atlasDepth ) );
	vec4 s2 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 2.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s3 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 3.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s4 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 4.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s5 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 5.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s6 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 6.0 * paddedSlices   ) / atlasDepth ) );
	vec3 c0 = s0.xyz;
	vec3 c1 = vec3( s0.w, s1.xy );
	vec3 c2 = vec3( s1.zw, s2.x );
	vec3 c3 = s2.yzw;
	vec3 c4 = s3.xyz;
	vec3 c5 = vec3( s3.w, s4.xy );
	vec3 c6 = vec3( s4.zw, s5.x );
	vec3 c7 = s5.yzw;
	vec3 c8 = s6.xyz;
	float x = worldNormal.x, y = worldNormal.y, z = worldNormal.z;
	vec3 result = c0 * 0.886227;
	result += c1 * 2.0 * 0.511664 * y;
	result += c2 * 2.0 * 0.511664 * z;
	result += c3 * 2.0 * 0.511664 * x;
	result += c4 * 2.0 * 0.429043 * x * y;
	result += c5 * 2.0 * 0.429043 * y * z;
	result += c6 * ( 0.743125 * z * z - 0.247708 );
	result += c7 * 2.0 * 0.429043 * x * z;
	result += c8 * 0.429043 * ( x * x - y * y );
	return max( result, vec3( 0.0 ) );
}
#endif`,X_=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	gl_FragDepth = vIsPerspective == 0.0 ? gl_FragCoord.z : log2( vFragDepth ) * logDepthBufFC * 0.5;
#endif`,q_=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	uniform float logDepthBufFC;
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,$_=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,Y_=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	vFragDepth = 1.0 + gl_Position.w;
	vIsPerspective = float( isPerspectiveMatrix( projectionMatrix ) );
#endif`,j_=`#ifdef USE_MAP
	vec4 sampledDiffuseColor = texture2D( map, vMapUv );
	#ifdef DECODE_VIDEO_TEXTURE
		sampledDiffuseColor = sRGBTransferEOTF( sampledDiffuseColor );
	#endif
	diffuseColor *= sampledDiffuseColor;
#endif`,Z_=`#ifdef USE_MAP
	uniform sampler2D map;
#endif`,J_=`#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
	#if defined( USE_POINTS_UV )
		vec2 uv = vUv;
	#else
		vec2 uv = ( uvTransform * vec3( gl_PointCoord.x, 1.0 - gl_PointCoord.y, 1 ) ).xy;
	#endif
#endif
#ifdef USE_MAP
	diffuseColor *= texture2D( map, uv );
#endif
#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, uv ).g;
#endif`,K_=`#if defined( USE_POINTS_UV )
	varying vec2 vUv;
#else
	#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
		uniform mat3 uvTransform;
	#endif
#endif
#ifdef USE_MAP
	uniform sampler2D map;
#endif
#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,Q_=`float metalnessFactor = metalness;
#ifdef USE_METALNESSMAP
	vec4 texelMetalness = texture2D( metalnessMap, vMetalnessMapUv );
	metalnessFactor *= texelMetalness.b;
#endif`,ev=`#ifdef USE_METALNESSMAP
	uniform sampler2D metalnessMap;
#endif`,tv=`#ifdef USE_INSTANCING_MORPH
	float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	float morphTargetBaseInfluence = texelFetch( morphTexture, ivec2( 0, gl_InstanceID ), 0 ).r;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		morphTargetInfluences[i] =  texelFetch( morphTexture, ivec2( i + 1, gl_InstanceID ), 0 ).r;
	}
#endif`,nv=`#if defined( USE_MORPHCOLORS )
	#if defined( USE_COLOR_ALPHA )
		vColor *= morphTargetBaseInfluence;
	#elif defined( USE_COLOR )
		vColor.rgb *= morphTargetBaseInfluence;
	#endif
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		#if defined( USE_COLOR_ALPHA )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor += getMorph( gl_VertexID, i, 2 ) * morphTargetInfluences[ i ];
		#elif defined( USE_COLOR )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor.rgb += getMorph( gl_VertexID, i, 2 ).rgb * morphTargetInfluences[ i ];
		#endif
	}
#endif`,iv=`#ifdef USE_MORPHNORMALS
	objectNormal *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) objectNormal += getMorph( gl_VertexID, i, 1 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,sv=`#ifdef USE_MORPHTARGETS
	#ifndef USE_INSTANCING_MORPH
		uniform float morphTargetBaseInfluence;
		uniform float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	#endif
	uniform sampler2DArray morphTargetsTexture;
	uniform ivec2 morphTargetsTextureSize;
	vec4 getMorph( const in int vertexIndex, const in int morphTargetIndex, const in int offset ) {
		int texelIndex = vertexIndex * MORPHTARGETS_TEXTURE_STRIDE + offset;
		int y = texelIndex / morphTargetsTextureSize.x;
		int x = texelIndex - y * morphTargetsTextureSize.x;
		ivec3 morphUV = ivec3( x, y, morphTargetIndex );
		return texelFetch( morphTargetsTexture, morphUV, 0 );
	}
#endif`,rv=`#ifdef USE_MORPHTARGETS
	transformed *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) transformed += getMorph( gl_VertexID, i, 0 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,ov=`float faceDirection = gl_FrontFacing ? 1.0 : - 1.0;
#ifdef FLAT_SHADED
	vec3 fdx = dFdx( vViewPosition );
	vec3 fdy = dFdy( vViewPosition );
	vec3 normal = normalize( cross( fdx, fdy ) );
#else
	vec3 normal = normalize( vNormal );
	#ifdef DOUBLE_SIDED
		normal *= faceDirection;
	#endif
#endif
#if defined( USE_NORMALMAP_TANGENTSPACE ) || defined( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY )
	#ifdef USE_TANGENT
		mat3 tbn = mat3( normalize( vTangent ), normalize( vBitangent ), normal );
	#else
		mat3 tbn = getTangentFrame( - vViewPosition, normal,
		#if defined( USE_NORMALMAP )
			vNormalMapUv
		#elif defined( USE_CLEARCOAT_NORMALMAP )
			vClearcoatNormalMapUv
		#else
			vUv
		#endif
		);
	#endif
	#ifdef DOUBLE_SIDED
		tbn[0] *= faceDirection;
		tbn[1] *= faceDirection;
	#endif
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	#ifdef USE_TANGENT
		mat3 tbn2 = mat3( normalize( vTangent ), normalize( vBitangent ), normal );
	#else
		mat3 tbn2 = getTangentFrame( - vViewPosition, normal, vClearcoatNormalMapUv );
	#endif
	#ifdef DOUBLE_SIDED
		tbn2[0] *= faceDirection;
		tbn2[1] *= faceDirection;
	#endif
#endif
vec3 nonPerturbedNormal = normal;`,av=`#ifdef USE_NORMALMAP_OBJECTSPACE
	normal = texture2D( normalMap, vNormalMapUv ).xyz * 2.0 - 1.0;
	#ifdef FLIP_SIDED
		normal = - normal;
	#endif
	#ifdef DOUBLE_SIDED
		normal = normal * faceDirection;
	#endif
	normal = normalize( normalMatrix * normal );
#elif defined( USE_NORMALMAP_TANGENTSPACE )
	vec3 mapN = texture2D( normalMap, vNormalMapUv ).xyz * 2.0 - 1.0;
	#if defined( USE_PACKED_NORMALMAP )
		mapN = vec3( mapN.xy, sqrt( saturate( 1.0 - dot( mapN.xy, mapN.xy ) ) ) );
	#endif
	mapN.xy *= normalScale;
	normal = normalize( tbn * mapN );
#elif defined( USE_BUMPMAP )
	normal = perturbNormalArb( - vViewPosition, normal, dHdxy_fwd(), faceDirection );
#endif`,lv=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,cv=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,hv=`#ifndef FLAT_SHADED
	vNormal = normalize( transformedNormal );
	#ifdef USE_TANGENT
		vTangent = normalize( transformedTangent );
		vBitangent = normalize( cross( vNormal, vTangent ) * tangent.w );
		#ifdef FLIP_SIDED
			vBitangent = - vBitangent;
		#endif
	#endif
#endif`,uv=`#ifdef USE_NORMALMAP
	uniform sampler2D normalMap;
	uniform vec2 normalScale;
#endif
#ifdef USE_NORMALMAP_OBJECTSPACE
	uniform mat3 normalMatrix;
#endif
#if ! defined ( USE_TANGENT ) && ( defined ( USE_NORMALMAP_TANGENTSPACE ) || defined ( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY ) )
	mat3 getTangentFrame( vec3 eye_pos, vec3 surf_norm, vec2 uv ) {
		vec3 q0 = dFdx( eye_pos.xyz );
		vec3 q1 = dFdy( eye_pos.xyz );
		vec2 st0 = dFdx( uv.st );
		vec2 st1 = dFdy( uv.st );
		vec3 N = surf_norm;
		vec3 q1perp = cross( q1, N );
		vec3 q0perp = cross( N, q0 );
		vec3 T = q1perp * st0.x + q0perp * st1.x;
		vec3 B = q1perp * st0.y + q0perp * st1.y;
		float det = max( dot( T, T ), dot( B, B ) );
		float scale = ( det == 0.0 ) ? 0.0 : inversesqrt( det );
		return mat3( T * scale, B * scale, N );
	}
#endif`,dv=`#ifdef USE_CLEARCOAT
	vec3 clearcoatNormal = nonPerturbedNormal;
#endif`,fv=`#ifdef USE_CLEARCOAT_NORMALMAP
	vec3 clearcoatMapN = texture2D( clearcoatNormalMap, vClearcoatNormalMapUv ).xyz * 2.0 - 1.0;
	clearcoatMapN.xy *= clearcoatNormalScale;
	clearcoatNormal = normalize( tbn2 * clearcoatMapN );
#endif`,pv=`#ifdef USE_CLEARCOATMAP
	uniform sampler2D clearcoatMap;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform sampler2D clearcoatNormalMap;
	uniform vec2 clearcoatNormalScale;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform sampler2D clearcoatRoughnessMap;
#endif`,mv=`#ifdef USE_IRIDESCENCEMAP
	uniform sampler2D iridescenceMap;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform sampler2D iridescenceThicknessMap;
#endif`,gv=`#ifdef OPAQUE
diffuseColor.a = 1.0;
#endif
#ifdef USE_TRANSMISSION
diffuseColor.a *= material.transmissionAlpha;
#endif
gl_FragColor = vec4( outgoingLight, diffuseColor.a );`,yv=`vec3 packNormalToRGB( const in vec3 normal ) {
	return normalize( normal ) * 0.5 + 0.5;
}
vec3 unpackRGBToNormal( const in vec3 rgb ) {
	return 2.0 * rgb.xyz - 1.0;
}
const float PackUpscale = 256. / 255.;const float UnpackDownscale = 255. / 256.;const float ShiftRight8 = 1. / 256.;
const float Inv255 = 1. / 255.;
const vec4 PackFactors = vec4( 1.0, 256.0, 256.0 * 256.0, 256.0 * 256.0 * 256.0 );
const vec2 UnpackFactors2 = vec2( UnpackDownscale, 1.0 / PackFactors.g );
const vec3 UnpackFactors3 = vec3( UnpackDownscale / PackFactors.rg, 1.0 / PackFactors.b );
const vec4 UnpackFactors4 = vec4( UnpackDownscale / PackFactors.rgb, 1.0 / PackFactors.a );
vec4 packDepthToRGBA( const in float v ) {
	if( v <= 0.0 )
		return vec4( 0., 0., 0., 0. );
	if( v >= 1.0 )
		return vec4( 1., 1., 1., 1. );
	float vuf;
	float af = modf( v * PackFactors.a, vuf );
	float bf = modf( vuf * ShiftRight8, vuf );
	float gf = modf( vuf * ShiftRight8, vuf );
	return vec4( vuf * Inv255, gf * PackUpscale, bf * PackUpscale, af );
}
vec3 packDepthToRGB( const in float v ) {
	if( v <= 0.0 )
		return vec3( 0., 0., 0. );
	if( v >= 1.0 )
		return vec3( 1., 1., 1. );
	float vuf;
	float bf = modf( v * PackFactors.b, vuf );
	float gf = modf( vuf * ShiftRight8, vuf );
	return vec3( vuf * Inv255, gf * PackUpscale, bf );
}
vec2 packDepthToRG( const in float v ) {
	if( v <= 0.0 )
		return vec2( 0., 0. );
	if( v >= 1.0 )
		return vec2( 1., 1. );
	float vuf;
	float gf = modf( v * 256., vuf );
	return vec2( vuf * Inv255, gf );
}
float unpackRGBAToDepth( const in vec4 v ) {
	return dot( v, UnpackFactors4 );
}
float unpackRGBToDepth( const in vec3 v ) {
	return dot( v, UnpackFactors3 );
}
float unpackRGToDepth( const in vec2 v ) {
	return v.r * UnpackFactors2.r + v.g * UnpackFactors2.g;
}
vec4 pack2HalfToRGBA( const in vec2 v ) {
	vec4 r = vec4( v.x, fract( v.x * 255.0 ), v.y, fract( v.y * 255.0 ) );
	return vec4( r.x - r.y / 255.0, r.y, r.z - r.w / 255.0, r.w );
}
vec2 unpackRGBATo2Half( const in vec4 v ) {
	return vec2( v.x + ( v.y / 255.0 ), v.z + ( v.w / 255.0 ) );
}
float viewZToOrthographicDepth( const in float viewZ, const in float near, const in float far ) {
	return ( viewZ + near ) / ( near - far );
}
float orthographicDepthToViewZ( const in float depth, const in float near, const in float far ) {
	#ifdef USE_REVERSED_DEPTH_BUFFER
	
		return depth * ( far - near ) - far;
	#else
		return depth * ( near - far ) - near;
	#endif
}
float viewZToPerspectiveDepth( const in float viewZ, const in float near, const in float far ) {
	return ( ( near + viewZ ) * far ) / ( ( far - near ) * viewZ );
}
float perspectiveDepthToViewZ( const in float depth, const in float near, const in float far ) {
	
	#ifdef USE_REVERSED_DEPTH_BUFFER
		return ( near * far ) / ( ( near - far ) * depth - near );
	#else
		return ( near * far ) / ( ( far - near ) * depth - far );
	#endif
}`,xv=`#ifdef PREMULTIPLIED_ALPHA
	gl_FragColor.rgb *= gl_FragColor.a;
#endif`,_v=`vec4 mvPosition = vec4( transformed, 1.0 );
#ifdef USE_BATCHING
	mvPosition = batchingMatrix * mvPosition;
#endif
#ifdef USE_INSTANCING
	mvPosition = instanceMatrix * mvPosition;
#endif
mvPosition = modelViewMatrix * mvPosition;
gl_Position = projectionMatrix * mvPosition;`,vv=`#ifdef DITHERING
	gl_FragColor.rgb = dithering( gl_FragColor.rgb );
#endif`,bv=`#ifdef DITHERING
	vec3 dithering( vec3 color ) {
		float grid_position = rand( gl_FragCoord.xy );
		vec3 dither_shift_RGB = vec3( 0.25 / 255.0, -0.25 / 255.0, 0.25 / 255.0 );
		dither_shift_RGB = mix( 2.0 * dither_shift_RGB, -2.0 * dither_shift_RGB, grid_position );
		return color + dither_shift_RGB;
	}
#endif`,Mv=`float roughnessFactor = roughness;
#ifdef USE_ROUGHNESSMAP
	vec4 texelRoughness = texture2D( roughnessMap, vRoughnessMapUv );
	roughnessFactor *= texelRoughness.g;
#endif`,Sv=`#ifdef USE_ROUGHNESSMAP
	uniform sampler2D roughnessMap;
#endif`,wv=`#if NUM_SPOT_LIGHT_COORDS > 0
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#if NUM_SPOT_LIGHT_MAPS > 0
	uniform sampler2D spotLightMap[ NUM_SPOT_LIGHT_MAPS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
		#define SUN_LIGHT_CASCADES 2
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow sunShadowMap[ NUM_SUN_LIGHT_SHADOWS ];
		#else
			uniform sampler2D sunShadowMap[ NUM_SUN_LIGHT_SHADOWS ];
		#endif
		uniform mat4 sunShadowMatrix[ NUM_SUN_LIGHT_SHADOWS * SUN_LIGHT_CASCADES ];
		uniform vec4 sunShadowCascade[ NUM_SUN_LIGHT_SHADOWS * SUN_LIGHT_CASCADES ];
		varying vec4 vSunShadowWorldPosition;
		varying vec3 vSunShadowWorldNormal;
		struct SunLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SunLightShadow sunLightShadows[ NUM_SUN_LIGHT_SHADOWS ];
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
		#else
			uniform sampler2D directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
		#endif
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
		#else
			uniform sampler2D spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
		#endif
		struct SpotLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform samplerCubeShadow pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
		#elif defined( SHADOWMAP_TYPE_BASIC )
			uniform samplerCube pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
		#endif
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
	#if defined( SHADOWMAP_TYPE_PCF )
		float interleavedGradientNoise( vec2 position ) {
			return fract( 52.9829189 * fract( dot( position, vec2( 0.06711056, 0.00583715 ) ) ) );
		}
		vec2 vogelDiskSample( int sampleIndex, int samplesCount, float phi ) {
			const float goldenAngle = 2.399963229728653;
			float r = sqrt( ( float( sampleIndex ) + 0.5 ) / float( samplesCount ) );
			float theta = float( sampleIndex ) * goldenAngle + phi;
			return vec2( cos( theta ), sin( theta ) ) * r;
		}
	#endif
	#if defined( SHADOWMAP_TYPE_PCF )
		float getShadow( sampler2DShadow shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				vec2 texelSize = vec2( 1.0 ) / shadowMapSize;
				vec2 radius = shadowRadius * texelSize;
				float phi = interleavedGradientNoise( gl_FragCoord.xy ) * PI2;
				shadow = (
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 0, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 1, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 2, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 3, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 4, 5, phi ) * radius, shadowCoord.z ) )
				) * 0.2;
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#elif defined( SHADOWMAP_TYPE_VSM )
		float getShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				vec2 distribution = texture2D( shadowMap, shadowCoord.xy ).rg;
				float mean = distribution.x;
				float variance = distribution.y * distribution.y;
				#ifdef USE_REVERSED_DEPTH_BUFFER
					float hard_shadow = step( mean, shadowCoord.z );
				#else
					float hard_shadow = step( shadowCoord.z, mean );
				#endif
				
				if ( hard_shadow == 1.0 ) {
					shadow = 1.0;
				} else {
					variance = max( variance, 0.0000001 );
					float d = shadowCoord.z - mean;
					float p_max = variance / ( variance + d * d );
					p_max = clamp( ( p_max - 0.3 ) / 0.65, 0.0, 1.0 );
					shadow = max( hard_shadow, p_max );
				}
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#else
		float getShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				float depth = texture2D( shadowMap, shadowCoord.xy ).r;
				#ifdef USE_REVERSED_DEPTH_BUFFER
					shadow = step( depth, shadowCoord.z );
				#else
					shadow = step( shadowCoord.z, depth );
				#endif
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#endif
	#if NUM_SUN_LIGHT_SHADOWS > 0
		float getSunShadow(
			#if defined( SHADOWMAP_TYPE_PCF )
				sampler2DShadow shadowMap,
			#else
				sampler2D shadowMap,
			#endif
			SunLightShadow sunLightShadow,
			int shadowIndex
		) {
			vec4 shadowWorldPosition = vec4( vSunShadowWorldPosition.xyz + vSunShadowWorldNormal * sunLightShadow.shadowNormalBias, 1.0 );
			float viewDepth = vSunShadowWorldPosition.w;
			int cascadeOffset = shadowIndex * SUN_LIGHT_CASCADES;
			float shadow = 1.0;
			for ( int i = SUN_LIGHT_CASCADES - 1; i >= 0; i -- ) {
				vec4 cascade = sunShadowCascade[ cascadeOffset + i ];
				if ( viewDepth >= cascade.x && viewDepth < cascade.y ) {
					float cascadeShadow = getShadow(
						shadowMap,
						sunLightShadow.shadowMapSize,
						sunLightShadow.shadowIntensity,
						sunLightShadow.shadowBias,
						sunLightShadow.shadowRadius,
						sunShadowMatrix[ cascadeOffset + i ] * shadowWorldPosition
					);
					shadow = mix( cascadeShadow, shadow, smoothstep( cascade.z, cascade.y, viewDepth ) );
				}
			}
			return shadow;
		}
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
	#if defined( SHADOWMAP_TYPE_PCF )
	float getPointShadow( samplerCubeShadow shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord, float shadowCameraNear, float shadowCameraFar ) {
		float shadow = 1.0;
		vec3 lightToPosition = shadowCoord.xyz;
		vec3 bd3D = normalize( lightToPosition );
		vec3 absVec = abs( lightToPosition );
		float viewSpaceZ = max( max( absVec.x, absVec.y ), absVec.z );
		if ( viewSpaceZ - shadowCameraFar <= 0.0 && viewSpaceZ - shadowCameraNear >= 0.0 ) {
			float lightDistance = length( lightToPosition );
			float depthRange = shadowCameraFar - shadowCameraNear;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				float depthA = - shadowCameraNear / depthRange - shadowBias;
				float depthB = shadowCameraNear * shadowCameraFar / ( depthRange * lightDistance );
			#else
				float depthA = shadowCameraFar / depthRange + shadowBias;
				float depthB = - shadowCameraNear * shadowCameraFar / ( depthRange * lightDistance );
			#endif
			float texelSize = shadowRadius / shadowMapSize.x;
			vec3 absDir = abs( bd3D );
			vec3 tangent = absDir.x > absDir.z ? vec3( 0.0, 1.0, 0.0 ) : vec3( 1.0, 0.0, 0.0 );
			tangent = normalize( cross( bd3D, tangent ) );
			vec3 bitangent = cross( bd3D, tangent );
			float phi = interleavedGradientNoise( gl_FragCoord.xy ) * PI2;
			shadow = 0.0;
			for ( int i = 0; i < 5; i ++ ) {
				vec2 offset = vogelDiskSample( i, 5, phi );
				vec3 direction = bd3D + ( tangent * offset.x + bitangent * offset.y ) * texelSize;
				vec3 absDirection = abs( direction );
				float dp = depthA + depthB / max( max( absDirection.x, absDirection.y ), absDirection.z );
				shadow += texture( shadowMap, vec4( direction, dp ) );
			}
			shadow *= 0.2;
		}
		return mix( 1.0, shadow, shadowIntensity );
	}
	#elif defined( SHADOWMAP_TYPE_BASIC )
	float getPointShadow( samplerCube shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord, float shadowCameraNear, float shadowCameraFar ) {
		float shadow = 1.0;
		vec3 lightToPosition = shadowCoord.xyz;
		vec3 absVec = abs( lightToPosition );
		float viewSpaceZ = max( max( absVec.x, absVec.y ), absVec.z );
		if ( viewSpaceZ - shadowCameraFar <= 0.0 && viewSpaceZ - shadowCameraNear >= 0.0 ) {
			float dp = ( shadowCameraFar * ( viewSpaceZ - shadowCameraNear ) ) / ( viewSpaceZ * ( shadowCameraFar - shadowCameraNear ) );
			dp += shadowBias;
			vec3 bd3D = normalize( lightToPosition );
			float depth = textureCube( shadowMap, bd3D ).r;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				depth = 1.0 - depth;
			#endif
			shadow = step( dp, depth );
		}
		return mix( 1.0, shadow, shadowIntensity );
	}
	#endif
	#endif
#endif`,Tv=`#if NUM_SPOT_LIGHT_COORDS > 0
	uniform mat4 spotLightMatrix[ NUM_SPOT_LIGHT_COORDS ];
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
		varying vec4 vSunShadowWorldPosition;
		varying vec3 vSunShadowWorldNormal;
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		uniform mat4 directionalShadowMatrix[ NUM_DIR_LIGHT_SHADOWS ];
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		struct SpotLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		uniform mat4 pointShadowMatrix[ NUM_POINT_LIGHT_SHADOWS ];
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
#endif`,Av=`#if ( defined( USE_SHADOWMAP ) && ( NUM_DIR_LIGHT_SHADOWS > 0 || NUM_SUN_LIGHT_SHADOWS > 0 || NUM_POINT_LIGHT_SHADOWS > 0 ) ) || ( NUM_SPOT_LIGHT_COORDS > 0 )
	#ifdef HAS_NORMAL
		vec3 shadowWorldNormal = transformNormalByInverseViewMatrix( transformedNormal, viewMatrix );
	#else
		vec3 shadowWorldNormal = vec3( 0.0 );
	#endif
	vec4 shadowWorldPosition;
#endif
#if defined( USE_SHADOWMAP )
	#if NUM_SUN_LIGHT_SHADOWS > 0
		vSunShadowWorldPosition = vec4( worldPosition.xyz, - mvPosition.z );
		vSunShadowWorldNormal = shadowWorldNormal;
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
			shadowWorldPosition = worldPosition + vec4( shadowWorldNormal * directionalLightShadows[ i ].shadowNormalBias, 0 );
			vDirectionalShadowCoord[ i ] = directionalShadowMatrix[ i ] * shadowWorldPosition;
		}
		#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
			shadowWorldPosition = worldPosition + vec4( shadowWorldNormal * pointLightShadows[ i ].shadowNormalBias, 0 );
			vPointShadowCoord[ i ] = pointShadowMatrix[ i ] * shadowWorldPosition;
		}
		#pragma unroll_loop_end
	#endif
#endif
#if NUM_SPOT_LIGHT_COORDS > 0
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_COORDS; i ++ ) {
		shadowWorldPosition = worldPosition;
		#if ( defined( USE_SHADOWMAP ) && UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
			shadowWorldPosition.xyz += shadowWorldNormal * spotLightShadows[ i ].shadowNormalBias;
		#endif
		vSpotLightCoord[ i ] = spotLightMatrix[ i ] * shadowWorldPosition;
	}
	#pragma unroll_loop_end
#endif`,Ev=`float getShadowMask() {
	float shadow = 1.0;
	#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
	SunLightShadow sunLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SUN_LIGHT_SHADOWS; i ++ ) {
		sunLight = sunLightShadows[ i ];
		shadow *= receiveShadow ? getSunShadow( sunShadowMap[ i ], sunLight, UNROLLED_LOOP_INDEX ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
		directionalLight = directionalLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( directionalShadowMap[ i ], directionalLight.shadowMapSize, directionalLight.shadowIntensity, directionalLight.shadowBias, directionalLight.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_SHADOWS; i ++ ) {
		spotLight = spotLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( spotShadowMap[ i ], spotLight.shadowMapSize, spotLight.shadowIntensity, spotLight.shadowBias, spotLight.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0 && ( defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_BASIC ) )
	PointLightShadow pointLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
		pointLight = pointLightShadows[ i ];
		shadow *= receiveShadow ? getPointShadow( pointShadowMap[ i ], pointLight.shadowMapSize, pointLight.shadowIntensity, pointLight.shadowBias, pointLight.shadowRadius, vPointShadowCoord[ i ], pointLight.shadowCameraNear, pointLight.shadowCameraFar ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#endif
	return shadow;
}`,Cv=`#ifdef USE_SKINNING
	mat4 boneMatX = getBoneMatrix( skinIndex.x );
	mat4 boneMatY = getBoneMatrix( skinIndex.y );
	mat4 boneMatZ = getBoneMatrix( skinIndex.z );
	mat4 boneMatW = getBoneMatrix( skinIndex.w );
#endif`,Rv=`#ifdef USE_SKINNING
	uniform mat4 bindMatrix;
	uniform mat4 bindMatrixInverse;
	uniform highp sampler2D boneTexture;
	mat4 getBoneMatrix( const in float i ) {
		int size = textureSize( boneTexture, 0 ).x;
		int j = int( i ) * 4;
		int x = j % size;
		int y = j / size;
		vec4 v1 = texelFetch( boneTexture, ivec2( x, y ), 0 );
		vec4 v2 = texelFetch( boneTexture, ivec2( x + 1, y ), 0 );
		vec4 v3 = texelFetch( boneTexture, ivec2( x + 2, y ), 0 );
		vec4 v4 = texelFetch( boneTexture, ivec2( x + 3, y ), 0 );
		return mat4( v1, v2, v3, v4 );
	}
#endif`,Pv=`#ifdef USE_SKINNING
	vec4 skinVertex = bindMatrix * vec4( transformed, 1.0 );
	vec4 skinned = vec4( 0.0 );
	skinned += boneMatX * skinVertex * skinWeight.x;
	skinned += boneMatY * skinVertex * skinWeight.y;
	skinned += boneMatZ * skinVertex * skinWeight.z;
	skinned += boneMatW * skinVertex * skinWeight.w;
	transformed = ( bindMatrixInverse * skinned ).xyz;
#endif`,Iv=`#ifdef USE_SKINNING
	mat4 skinMatrix = mat4( 0.0 );
	skinMatrix += skinWeight.x * boneMatX;
	skinMatrix += skinWeight.y * boneMatY;
	skinMatrix += skinWeight.z * boneMatZ;
	skinMatrix += skinWeight.w * boneMatW;
	skinMatrix = bindMatrixInverse * skinMatrix * bindMatrix;
	objectNormal = vec4( skinMatrix * vec4( objectNormal, 0.0 ) ).xyz;
	#ifdef USE_TANGENT
		objectTangent = vec4( skinMatrix * vec4( objectTangent, 0.0 ) ).xyz;
	#endif
#endif`,Lv=`float specularStrength;
#ifdef USE_SPECULARMAP
	vec4 texelSpecular = texture2D( specularMap, vSpecularMapUv );
	specularStrength = texelSpecular.r;
#else
	specularStrength = 1.0;
#endif`,Nv=`#ifdef USE_SPECULARMAP
	uniform sampler2D specularMap;
#endif`,Dv=`#if defined( TONE_MAPPING )
	gl_FragColor.rgb = toneMapping( gl_FragColor.rgb );
#endif`,Ov=`#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
uniform float toneMappingExposure;
vec3 LinearToneMapping( vec3 color ) {
	return saturate( toneMappingExposure * color );
}
vec3 ReinhardToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	return saturate( color / ( vec3( 1.0 ) + color ) );
}
vec3 CineonToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	color = max( vec3( 0.0 ), color - 0.004 );
	return pow( ( color * ( 6.2 * color + 0.5 ) ) / ( color * ( 6.2 * color + 1.7 ) + 0.06 ), vec3( 2.2 ) );
}
vec3 RRTAndODTFit( vec3 v ) {
	vec3 a = v * ( v + 0.0245786 ) - 0.000090537;
	vec3 b = v * ( 0.983729 * v + 0.4329510 ) + 0.238081;
	return a / b;
}
vec3 ACESFilmicToneMapping( vec3 color ) {
	const mat3 ACESInputMat = mat3(
		vec3( 0.59719, 0.07600, 0.02840 ),		vec3( 0.35458, 0.90834, 0.13383 ),
		vec3( 0.04823, 0.01566, 0.83777 )
	);
	const mat3 ACESOutputMat = mat3(
		vec3(  1.60475, -0.10208, -0.00327 ),		vec3( -0.53108,  1.10813, -0.07276 ),
		vec3( -0.07367, -0.00605,  1.07602 )
	);
	color *= toneMappingExposure / 0.6;
	color = ACESInputMat * color;
	color = RRTAndODTFit( color );
	color = ACESOutputMat * color;
	return saturate( color );
}
const mat3 LINEAR_REC2020_TO_LINEAR_SRGB = mat3(
	vec3( 1.6605, - 0.1246, - 0.0182 ),
	vec3( - 0.5876, 1.1329, - 0.1006 ),
	vec3( - 0.0728, - 0.0083, 1.1187 )
);
const mat3 LINEAR_SRGB_TO_LINEAR_REC2020 = mat3(
	vec3( 0.6274, 0.0691, 0.0164 ),
	vec3( 0.3293, 0.9195, 0.0880 ),
	vec3( 0.0433, 0.0113, 0.8956 )
);
vec3 agxDefaultContrastApprox( vec3 x ) {
	vec3 x2 = x * x;
	vec3 x4 = x2 * x2;
	return + 15.5 * x4 * x2
		- 40.14 * x4 * x
		+ 31.96 * x4
		- 6.868 * x2 * x
		+ 0.4298 * x2
		+ 0.1191 * x
		- 0.00232;
}
vec3 AgXToneMapping( vec3 color ) {
	const mat3 AgXInsetMatrix = mat3(
		vec3( 0.856627153315983, 0.137318972929847, 0.11189821299995 ),
		vec3( 0.0951212405381588, 0.761241990602591, 0.0767994186031903 ),
		vec3( 0.0482516061458583, 0.101439036467562, 0.811302368396859 )
	);
	const mat3 AgXOutsetMatrix = mat3(
		vec3( 1.1271005818144368, - 0.1413297634984383, - 0.14132976349843826 ),
		vec3( - 0.11060664309660323, 1.157823702216272, - 0.11060664309660294 ),
		vec3( - 0.016493938717834573, - 0.016493938717834257, 1.2519364065950405 )
	);
	const float AgxMinEv = - 12.47393;	const float AgxMaxEv = 4.026069;
	color *= toneMappingExposure;
	color = LINEAR_SRGB_TO_LINEAR_REC2020 * color;
	color = AgXInsetMatrix * color;
	color = max( color, 1e-10 );	color = log2( color );
	color = ( color - AgxMinEv ) / ( AgxMaxEv - AgxMinEv );
	color = clamp( color, 0.0, 1.0 );
	color = agxDefaultContrastApprox( color );
	color = AgXOutsetMatrix * color;
	color = pow( max( vec3( 0.0 ), color ), vec3( 2.2 ) );
	color = LINEAR_REC2020_TO_LINEAR_SRGB * color;
	color = clamp( color, 0.0, 1.0 );
	return color;
}
vec3 NeutralToneMapping( vec3 color ) {
	const float StartCompression = 0.8 - 0.04;
	const float Desaturation = 0.15;
	color *= toneMappingExposure;
	float x = min( color.r, min( color.g, color.b ) );
	float offset = x < 0.08 ? x - 6.25 * x * x : 0.04;
	color -= offset;
	float peak = max( color.r, max( color.g, color.b ) );
	if ( peak < StartCompression ) return color;
	float d = 1. - StartCompression;
	float newPeak = 1. - d * d / ( peak + d - StartCompression );
	color *= newPeak / peak;
	float g = 1. - 1. / ( Desaturation * ( peak - newPeak ) + 1. );
	return mix( color, vec3( newPeak ), g );
}
vec3 CustomToneMapping( vec3 color ) { return color; }`,Uv=`#ifdef USE_TRANSMISSION
	material.transmission = transmission;
	material.transmissionAlpha = 1.0;
	material.thickness = thickness;
	material.attenuationDistance = attenuationDistance;
	material.attenuationColor = attenuationColor;
	#ifdef USE_TRANSMISSIONMAP
		material.transmission *= texture2D( transmissionMap, vTransmissionMapUv ).r;
	#endif
	#ifdef USE_THICKNESSMAP
		material.thickness *= texture2D( thicknessMap, vThicknessMapUv ).g;
	#endif
	vec3 pos = vWorldPosition;
	vec3 v = normalize( cameraPosition - pos );
	vec3 n = transformNormalByInverseViewMatrix( normal, viewMatrix );
	vec4 transmitted = getIBLVolumeRefraction(
		n, v, material.roughness, material.diffuseContribution, material.specularColorBlended, material.specularF90,
		pos, modelMatrix, viewMatrix, projectionMatrix, material.dispersion, material.ior, material.thickness,
		material.attenuationColor, material.attenuationDistance );
	material.transmissionAlpha = mix( material.transmissionAlpha, transmitted.a, material.transmission );
	totalDiffuse = mix( totalDiffuse, transmitted.rgb, material.transmission );
#endif`,Fv=`#ifdef USE_TRANSMISSION
	uniform float transmission;
	uniform float thickness;
	uniform float attenuationDistance;
	uniform vec3 attenuationColor;
	#ifdef USE_TRANSMISSIONMAP
		uniform sampler2D transmissionMap;
	#endif
	#ifdef USE_THICKNESSMAP
		uniform sampler2D thicknessMap;
	#endif
	uniform vec2 transmissionSamplerSize;
	uniform sampler2D transmissionSamplerMap;
	uniform mat4 modelMatrix;
	uniform mat4 projectionMatrix;
	varying vec3 vWorldPosition;
	float w0( float a ) {
		return ( 1.0 / 6.0 ) * ( a * ( a * ( - a + 3.0 ) - 3.0 ) + 1.0 );
	}
	float w1( float a ) {
		return ( 1.0 / 6.0 ) * ( a *  a * ( 3.0 * a - 6.0 ) + 4.0 );
	}
	float w2( float a ){
		return ( 1.0 / 6.0 ) * ( a * ( a * ( - 3.0 * a + 3.0 ) + 3.0 ) + 1.0 );
	}
	float w3( float a ) {
		return ( 1.0 / 6.0 ) * ( a * a * a );
	}
	float g0( float a ) {
		return w0( a ) + w1( a );
	}
	float g1( float a ) {
		return w2( a ) + w3( a );
	}
	float h0( float a ) {
		return - 1.0 + w1( a ) / ( w0( a ) + w1( a ) );
	}
	float h1( float a ) {
		return 1.0 + w3( a ) / ( w2( a ) + w3( a ) );
	}
	vec4 bicubic( sampler2D tex, vec2 uv, vec4 texelSize, float lod ) {
		uv = uv * texelSize.zw + 0.5;
		vec2 iuv = floor( uv );
		vec2 fuv = fract( uv );
		float g0x = g0( fuv.x );
		float g1x = g1( fuv.x );
		float h0x = h0( fuv.x );
		float h1x = h1( fuv.x );
		float h0y = h0( fuv.y );
		float h1y = h1( fuv.y );
		vec2 p0 = ( vec2( iuv.x + h0x, iuv.y + h0y ) - 0.5 ) * texelSize.xy;
		vec2 p1 = ( vec2( iuv.x + h1x, iuv.y + h0y ) - 0.5 ) * texelSize.xy;
		vec2 p2 = ( vec2( iuv.x + h0x, iuv.y + h1y ) - 0.5 ) * texelSize.xy;
		vec2 p3 = ( vec2( iuv.x + h1x, iuv.y + h1y ) - 0.5 ) * texelSize.xy;
		return g0( fuv.y ) * ( g0x * textureLod( tex, p0, lod ) + g1x * textureLod( tex, p1, lod ) ) +
			g1( fuv.y ) * ( g0x * textureLod( tex, p2, lod ) + g1x * textureLod( tex, p3, lod ) );
	}
	vec4 textureBicubic( sampler2D sampler, vec2 uv, float lod ) {
		vec2 fLodSize = vec2( textureSize( sampler, int( lod ) ) );
		vec2 cLodSize = vec2( textureSize( sampler, int( lod + 1.0 ) ) );
		vec2 fLodSizeInv = 1.0 / fLodSize;
		vec2 cLodSizeInv = 1.0 / cLodSize;
		vec4 fSample = bicubic( sampler, uv, vec4( fLodSizeInv, fLodSize ), floor( lod ) );
		vec4 cSample = bicubic( sampler, uv, vec4( cLodSizeInv, cLodSize ), ceil( lod ) );
		return mix( fSample, cSample, fract( lod ) );
	}
	vec3 getVolumeTransmissionRay( const in vec3 n, const in vec3 v, const in float thickness, const in float ior, const in mat4 modelMatrix ) {
		vec3 refractionVector = refract( - v, normalize( n ), 1.0 / ior );
		vec3 modelScale;
		modelScale.x = length( vec3( modelMatrix[ 0 ].xyz ) );
		modelScale.y = length( vec3( modelMatrix[ 1 ].xyz ) );
		modelScale.z = length( vec3( modelMatrix[ 2 ].xyz ) );
		return normalize( refractionVector ) * thickness * modelScale;
	}
	float applyIorToRoughness( const in float roughness, const in float ior ) {
		return roughness * clamp( ior * 2.0 - 2.0, 0.0, 1.0 );
	}
	vec4 getTransmissionSample( const in vec2 fragCoord, const in float roughness, const in float ior ) {
		float lod = log2( transmissionSamplerSize.x ) * applyIorToRoughness( roughness, ior );
		return textureBicubic( transmissionSamplerMap, fragCoord.xy, lod );
	}
	vec3 volumeAttenuation( const in float transmissionDistance, const in vec3 attenuationColor, const in float attenuationDistance ) {
		if ( isinf( attenuationDistance ) ) {
			return vec3( 1.0 );
		} else {
			vec3 attenuationCoefficient = -log( attenuationColor ) / attenuationDistance;
			vec3 transmittance = exp( - attenuationCoefficient * transmissionDistance );			return transmittance;
		}
	}
	vec4 getIBLVolumeRefraction( const in vec3 n, const in vec3 v, const in float roughness, const in vec3 diffuseColor,
		const in vec3 specularColor, const in float specularF90, const in vec3 position, const in mat4 modelMatrix,
		const in mat4 viewMatrix, const in mat4 projMatrix, const in float dispersion, const in float ior, const in float thickness,
		const in vec3 attenuationColor, const in float attenuationDistance ) {
		vec4 transmittedLight;
		vec3 transmittance;
		#ifdef USE_DISPERSION
			float halfSpread = ( ior - 1.0 ) * 0.025 * dispersion;
			vec3 iors = vec3( ior - halfSpread, ior, ior + halfSpread );
			for ( int i = 0; i < 3; i ++ ) {
				vec3 transmissionRay = getVolumeTransmissionRay( n, v, thickness, iors[ i ], modelMatrix );
				vec3 refractedRayExit = position + transmissionRay;
				vec4 ndcPos = projMatrix * viewMatrix * vec4( refractedRayExit, 1.0 );
				vec2 refractionCoords = ndcPos.xy / ndcPos.w;
				refractionCoords += 1.0;
				refractionCoords /= 2.0;
				vec4 transmissionSample = getTransmissionSample( refractionCoords, roughness, iors[ i ] );
				transmittedLight[ i ] = transmissionSample[ i ];
				transmittedLight.a += transmissionSample.a;
				transmittance[ i ] = diffuseColor[ i ] * volumeAttenuation( length( transmissionRay ), attenuationColor, attenuationDistance )[ i ];
			}
			transmittedLight.a /= 3.0;
		#else
			vec3 transmissionRay = getVolumeTransmissionRay( n, v, thickness, ior, modelMatrix );
			vec3 refractedRayExit = position + transmissionRay;
			vec4 ndcPos = projMatrix * viewMatrix * vec4( refractedRayExit, 1.0 );
			vec2 refractionCoords = ndcPos.xy / ndcPos.w;
			refractionCoords += 1.0;
			refractionCoords /= 2.0;
			transmittedLight = getTransmissionSample( refractionCoords, roughness, ior );
			transmittance = diffuseColor * volumeAttenuation( length( transmissionRay ), attenuationColor, attenuationDistance );
		#endif
		vec3 attenuatedColor = transmittance * transmittedLight.rgb;
		vec3 F = EnvironmentBRDF( n, v, specularColor, specularF90, roughness );
		float transmittanceFactor = ( transmittance.r + transmittance.g + transmittance.b ) / 3.0;
		return vec4( ( 1.0 - F ) * attenuatedColor, 1.0 - ( 1.0 - transmittedLight.a ) * transmittanceFactor );
	}
#endif`,Bv=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	varying vec2 vUv;
#endif
#ifdef USE_MAP
	varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
	varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
	varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
	varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
	varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
	varying vec2 vNormalMapUv;
#endif
#ifdef USE_EMISSIVEMAP
	varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
	varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
	varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	varying vec2 vDiffuseRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
	varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
	varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
	varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
	varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_SPECULARMAP
	varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
	varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
	uniform mat3 transmissionMapTransform;
	varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
	uniform mat3 thicknessMapTransform;
	varying vec2 vThicknessMapUv;
#endif`,kv=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	varying vec2 vUv;
#endif
#ifdef USE_MAP
	uniform mat3 mapTransform;
	varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
	uniform mat3 alphaMapTransform;
	varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
	uniform mat3 lightMapTransform;
	varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
	uniform mat3 aoMapTransform;
	varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
	uniform mat3 bumpMapTransform;
	varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
	uniform mat3 normalMapTransform;
	varying vec2 vNormalMapUv;
#endif
#ifdef USE_DISPLACEMENTMAP
	uniform mat3 displacementMapTransform;
	varying vec2 vDisplacementMapUv;
#endif
#ifdef USE_EMISSIVEMAP
	uniform mat3 emissiveMapTransform;
	varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
	uniform mat3 metalnessMapTransform;
	varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
	uniform mat3 roughnessMapTransform;
	varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	uniform mat3 diffuseRoughnessMapTransform;
	varying vec2 vDiffuseRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
	uniform mat3 anisotropyMapTransform;
	varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
	uniform mat3 clearcoatMapTransform;
	varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform mat3 clearcoatNormalMapTransform;
	varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform mat3 clearcoatRoughnessMapTransform;
	varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
	uniform mat3 sheenColorMapTransform;
	varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	uniform mat3 sheenRoughnessMapTransform;
	varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
	uniform mat3 iridescenceMapTransform;
	varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform mat3 iridescenceThicknessMapTransform;
	varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SPECULARMAP
	uniform mat3 specularMapTransform;
	varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
	uniform mat3 specularColorMapTransform;
	varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	uniform mat3 specularIntensityMapTransform;
	varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
	uniform mat3 transmissionMapTransform;
	varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
	uniform mat3 thicknessMapTransform;
	varying vec2 vThicknessMapUv;
#endif`,zv=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	vUv = vec3( uv, 1 ).xy;
#endif
#ifdef USE_MAP
	vMapUv = ( mapTransform * vec3( MAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ALPHAMAP
	vAlphaMapUv = ( alphaMapTransform * vec3( ALPHAMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_LIGHTMAP
	vLightMapUv = ( lightMapTransform * vec3( LIGHTMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_AOMAP
	vAoMapUv = ( aoMapTransform * vec3( AOMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_BUMPMAP
	vBumpMapUv = ( bumpMapTransform * vec3( BUMPMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_NORMALMAP
	vNormalMapUv = ( normalMapTransform * vec3( NORMALMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_DISPLACEMENTMAP
	vDisplacementMapUv = ( displacementMapTransform * vec3( DISPLACEMENTMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_EMISSIVEMAP
	vEmissiveMapUv = ( emissiveMapTransform * vec3( EMISSIVEMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_METALNESSMAP
	vMetalnessMapUv = ( metalnessMapTransform * vec3( METALNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ROUGHNESSMAP
	vRoughnessMapUv = ( roughnessMapTransform * vec3( ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	vDiffuseRoughnessMapUv = ( diffuseRoughnessMapTransform * vec3( DIFFUSE_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ANISOTROPYMAP
	vAnisotropyMapUv = ( anisotropyMapTransform * vec3( ANISOTROPYMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOATMAP
	vClearcoatMapUv = ( clearcoatMapTransform * vec3( CLEARCOATMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	vClearcoatNormalMapUv = ( clearcoatNormalMapTransform * vec3( CLEARCOAT_NORMALMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	vClearcoatRoughnessMapUv = ( clearcoatRoughnessMapTransform * vec3( CLEARCOAT_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_IRIDESCENCEMAP
	vIridescenceMapUv = ( iridescenceMapTransform * vec3( IRIDESCENCEMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	vIridescenceThicknessMapUv = ( iridescenceThicknessMapTransform * vec3( IRIDESCENCE_THICKNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SHEEN_COLORMAP
	vSheenColorMapUv = ( sheenColorMapTransform * vec3( SHEEN_COLORMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	vSheenRoughnessMapUv = ( sheenRoughnessMapTransform * vec3( SHEEN_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULARMAP
	vSpecularMapUv = ( specularMapTransform * vec3( SPECULARMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULAR_COLORMAP
	vSpecularColorMapUv = ( specularColorMapTransform * vec3( SPECULAR_COLORMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	vSpecularIntensityMapUv = ( specularIntensityMapTransform * vec3( SPECULAR_INTENSITYMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_TRANSMISSIONMAP
	vTransmissionMapUv = ( transmissionMapTransform * vec3( TRANSMISSIONMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_THICKNESSMAP
	vThicknessMapUv = ( thicknessMapTransform * vec3( THICKNESSMAP_UV, 1 ) ).xy;
#endif`,Vv=`#if defined( USE_ENVMAP ) || defined( DISTANCE ) || defined ( USE_SHADOWMAP ) || defined ( USE_TRANSMISSION ) || NUM_SPOT_LIGHT_COORDS > 0
	vec4 worldPosition = vec4( transformed, 1.0 );
	#ifdef USE_BATCHING
		worldPosition = batchingMatrix * worldPosition;
	#endif
	#ifdef USE_INSTANCING
		worldPosition = instanceMatrix * worldPosition;
	#endif
	worldPosition = modelMatrix * worldPosition;
#endif`,Gv=`varying vec2 vUv;
uniform mat3 uvTransform;
void main() {
	vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	gl_Position = vec4( position.xy, 1.0, 1.0 );
}`,Hv=`uniform sampler2D t2D;
uniform float backgroundIntensity;
varying vec2 vUv;
void main() {
	vec4 texColor = texture2D( t2D, vUv );
	#ifdef DECODE_VIDEO_TEXTURE
		texColor = vec4( mix( pow( texColor.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), texColor.rgb * 0.0773993808, vec3( lessThanEqual( texColor.rgb, vec3( 0.04045 ) ) ) ), texColor.w );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,Wv=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,Xv=`uniform float backgroundBlurriness;
uniform float backgroundIntensity;
uniform mat3 backgroundRotation;
varying vec3 vWorldDirection;
#include <envmap_common_pars_fragment>
void main() {
	#ifdef ENVMAP_TYPE_PMREM
		vec4 texColor = textureLod( envMap, backgroundRotation * vWorldDirection, roughnessToMip( backgroundBlurriness ) );
	#else
		vec4 texColor = textureCube( envMap, backgroundRotation * vWorldDirection );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,qv=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,$v=`uniform samplerCube tCube;
uniform float tFlip;
uniform float opacity;
varying vec3 vWorldDirection;
void main() {
	vec4 texColor = textureCube( tCube, vec3( tFlip * vWorldDirection.x, vWorldDirection.yz ) );
	gl_FragColor = texColor;
	gl_FragColor.a *= opacity;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,Yv=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
varying vec2 vHighPrecisionZW;
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <skinbase_vertex>
	#include <morphinstance_vertex>
	#ifdef USE_DISPLACEMENTMAP
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vHighPrecisionZW = gl_Position.zw;
}`,jv=`#if DEPTH_PACKING == 3200
	uniform float opacity;
#endif
#include <common>
#include <packing>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
varying vec2 vHighPrecisionZW;
void main() {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#if DEPTH_PACKING == 3200
		diffuseColor.a = opacity;
	#endif
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <logdepthbuf_fragment>
	#ifdef USE_REVERSED_DEPTH_BUFFER
		float fragCoordZ = vHighPrecisionZW[ 0 ] / vHighPrecisionZW[ 1 ];
	#else
		float fragCoordZ = 0.5 * vHighPrecisionZW[ 0 ] / vHighPrecisionZW[ 1 ] + 0.5;
	#endif
	#if DEPTH_PACKING == 3200
		gl_FragColor = vec4( vec3( 1.0 - fragCoordZ ), opacity );
	#elif DEPTH_PACKING == 3201
		gl_FragColor = packDepthToRGBA( fragCoordZ );
	#elif DEPTH_PACKING == 3202
		gl_FragColor = vec4( packDepthToRGB( fragCoordZ ), 1.0 );
	#elif DEPTH_PACKING == 3203
		gl_FragColor = vec4( packDepthToRG( fragCoordZ ), 0.0, 1.0 );
	#endif
}`,Zv=`#define DISTANCE
varying vec3 vWorldPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <skinbase_vertex>
	#include <morphinstance_vertex>
	#ifdef USE_DISPLACEMENTMAP
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <worldpos_vertex>
	#include <clipping_planes_vertex>
	vWorldPosition = worldPosition.xyz;
}`,Jv=`#define DISTANCE
uniform vec3 referencePosition;
uniform float nearDistance;
uniform float farDistance;
varying vec3 vWorldPosition;
#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	float dist = length( vWorldPosition - referencePosition );
	dist = ( dist - nearDistance ) / ( farDistance - nearDistance );
	dist = saturate( dist );
	gl_FragColor = vec4( dist, 0.0, 0.0, 1.0 );
}`,Kv=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
}`,Qv=`uniform sampler2D tEquirect;
varying vec3 vWorldDirection;
#include <common>
void main() {
	vec3 direction = normalize( vWorldDirection );
	vec2 sampleUV = equirectUv( direction );
	gl_FragColor = texture2D( tEquirect, sampleUV );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,eb=`uniform float scale;
attribute float lineDistance;
varying float vLineDistance;
#include <common>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	vLineDistance = scale * lineDistance;
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
}`,tb=`uniform vec3 diffuse;
uniform float opacity;
uniform float dashSize;
uniform float totalSize;
varying float vLineDistance;
#include <common>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	if ( mod( vLineDistance, totalSize ) > dashSize ) {
		discard;
	}
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,nb=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#if defined ( USE_ENVMAP ) || defined ( USE_SKINNING )
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinbase_vertex>
		#include <skinnormal_vertex>
		#include <defaultnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <fog_vertex>
}`,ib=`uniform vec3 diffuse;
uniform float opacity;
#ifndef FLAT_SHADED
	varying vec3 vNormal;
#endif
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <fog_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		reflectedLight.indirectDiffuse += lightMapTexel.rgb * lightMapIntensity * RECIPROCAL_PI;
	#else
		reflectedLight.indirectDiffuse += vec3( 1.0 );
	#endif
	#include <aomap_fragment>
	reflectedLight.indirectDiffuse *= diffuseColor.rgb;
	vec3 outgoingLight = reflectedLight.indirectDiffuse;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,sb=`#define LAMBERT
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,rb=`#define LAMBERT
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_lambert_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_lambert_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,ob=`#define MATCAP
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <displacementmap_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
	vViewPosition = - mvPosition.xyz;
}`,ab=`#define MATCAP
uniform vec3 diffuse;
uniform float opacity;
uniform sampler2D matcap;
varying vec3 vViewPosition;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	vec3 viewDir = normalize( vViewPosition );
	vec3 x = normalize( vec3( viewDir.z, 0.0, - viewDir.x ) );
	vec3 y = cross( viewDir, x );
	vec2 uv = vec2( dot( x, normal ), dot( y, normal ) ) * 0.495 + 0.5;
	#ifdef USE_MATCAP
		vec4 matcapColor = texture2D( matcap, uv );
	#else
		vec4 matcapColor = vec4( vec3( mix( 0.2, 0.8, uv.y ) ), 1.0 );
	#endif
	vec3 outgoingLight = diffuseColor.rgb * matcapColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,lb=`#define NORMAL
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	vViewPosition = - mvPosition.xyz;
#endif
}`,cb=`#define NORMAL
uniform float opacity;
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
#include <uv_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( 0.0, 0.0, 0.0, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	gl_FragColor = vec4( normalize( normal ) * 0.5 + 0.5, diffuseColor.a );
	#ifdef OPAQUE
		gl_FragColor.a = 1.0;
	#endif
}`,hb=`#define PHONG
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,ub=`#define PHONG
uniform vec3 diffuse;
uniform vec3 emissive;
uniform vec3 specular;
uniform float shininess;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_phong_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_phong_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + reflectedLight.directSpecular + reflectedLight.indirectSpecular + totalEmissiveRadiance;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,db=`#define STANDARD
varying vec3 vViewPosition;
#ifdef USE_TRANSMISSION
	varying vec3 vWorldPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
#ifdef USE_TRANSMISSION
	vWorldPosition = worldPosition.xyz;
#endif
}`,fb=`#define STANDARD
#ifdef PHYSICAL
	#define IOR
	#define USE_SPECULAR
#endif
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float roughness;
uniform float metalness;
uniform float opacity;
#ifdef IOR
	uniform float ior;
#endif
#ifdef USE_SPECULAR
	uniform float specularIntensity;
	uniform vec3 specularColor;
	#ifdef USE_SPECULAR_COLORMAP
		uniform sampler2D specularColorMap;
	#endif
	#ifdef USE_SPECULAR_INTENSITYMAP
		uniform sampler2D specularIntensityMap;
	#endif
#endif
#ifdef USE_CLEARCOAT
	uniform float clearcoat;
	uniform float clearcoatRoughness;
#endif
#ifdef USE_DIFFUSE_ROUGHNESS
	uniform float diffuseRoughness;
	#ifdef USE_DIFFUSE_ROUGHNESSMAP
		uniform sampler2D diffuseRoughnessMap;
	#endif
#endif
#ifdef USE_DISPERSION
	uniform float dispersion;
#endif
#ifdef USE_RETROREFLECTION
	uniform float retroreflectivity;
#endif
#ifdef USE_IRIDESCENCE
	uniform float iridescence;
	uniform float iridescenceIOR;
	uniform float iridescenceThicknessMinimum;
	uniform float iridescenceThicknessMaximum;
#endif
#ifdef USE_SHEEN
	uniform vec3 sheenColor;
	uniform float sheenRoughness;
	#ifdef USE_SHEEN_COLORMAP
		uniform sampler2D sheenColorMap;
	#endif
	#ifdef USE_SHEEN_ROUGHNESSMAP
		uniform sampler2D sheenRoughnessMap;
	#endif
#endif
#ifdef USE_ANISOTROPY
	uniform vec2 anisotropyVector;
	#ifdef USE_ANISOTROPYMAP
		uniform sampler2D anisotropyMap;
	#endif
#endif
varying vec3 vViewPosition;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <iridescence_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_physical_pars_fragment>
#include <transmission_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <clearcoat_pars_fragment>
#include <iridescence_pars_fragment>
#include <roughnessmap_pars_fragment>
#include <metalnessmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <roughnessmap_fragment>
	#include <metalnessmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <clearcoat_normal_fragment_begin>
	#include <clearcoat_normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_physical_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 totalDiffuse = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse;
	vec3 totalSpecular = reflectedLight.directSpecular + reflectedLight.indirectSpecular;
	#include <transmission_fragment>
	vec3 outgoingLight = totalDiffuse + totalSpecular + totalEmissiveRadiance;
	#ifdef USE_SHEEN
 
		outgoingLight = outgoingLight + sheenSpecularDirect + sheenSpecularIndirect;
 
 	#endif
	#ifdef USE_CLEARCOAT
		float dotNVcc = saturate( dot( geometryClearcoatNormal, geometryViewDir ) );
		vec3 Fcc = F_Schlick( material.clearcoatF0, material.clearcoatF90, dotNVcc );
		outgoingLight = outgoingLight * ( 1.0 - material.clearcoat * Fcc ) + ( clearcoatSpecularDirect + clearcoatSpecularIndirect ) * material.clearcoat;
	#endif
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,pb=`#define TOON
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,mb=`#define TOON
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <gradientmap_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_toon_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_toon_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,gb=`uniform float size;
uniform float scale;
#include <common>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
#ifdef USE_POINTS_UV
	varying vec2 vUv;
	uniform mat3 uvTransform;
#endif
void main() {
	#ifdef USE_POINTS_UV
		vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	#endif
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <project_vertex>
	gl_PointSize = size;
	#ifdef USE_SIZEATTENUATION
		bool isPerspective = isPerspectiveMatrix( projectionMatrix );
		if ( isPerspective ) gl_PointSize *= ( scale / - mvPosition.z );
	#endif
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <worldpos_vertex>
	#include <fog_vertex>
}`,yb=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <color_pars_fragment>
#include <map_particle_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_particle_fragment>
	#include <color_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,xb=`#include <common>
#include <batching_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <shadowmap_pars_vertex>
void main() {
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,_b=`uniform vec3 color;
uniform float opacity;
#include <common>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <logdepthbuf_pars_fragment>
#include <shadowmap_pars_fragment>
#include <shadowmask_pars_fragment>
void main() {
	#include <logdepthbuf_fragment>
	gl_FragColor = vec4( color, opacity * ( 1.0 - getShadowMask() ) );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,vb=`uniform float rotation;
uniform vec2 center;
#include <common>
#include <uv_pars_vertex>
#include <fog_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	vec4 mvPosition = modelViewMatrix[ 3 ];
	vec2 scale = vec2( length( modelMatrix[ 0 ].xyz ), length( modelMatrix[ 1 ].xyz ) );
	#ifndef USE_SIZEATTENUATION
		bool isPerspective = isPerspectiveMatrix( projectionMatrix );
		if ( isPerspective ) scale *= - mvPosition.z;
	#endif
	vec2 alignedPosition = ( position.xy - ( center - vec2( 0.5 ) ) ) * scale;
	vec2 rotatedPosition;
	rotatedPosition.x = cos( rotation ) * alignedPosition.x - sin( rotation ) * alignedPosition.y;
	rotatedPosition.y = sin( rotation ) * alignedPosition.x + cos( rotation ) * alignedPosition.y;
	mvPosition.xy += rotatedPosition;
	gl_Position = projectionMatrix * mvPosition;
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
}`,bb=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
}`,We={alphahash_fragment:Hx,alphahash_pars_fragment:Wx,alphamap_fragment:Xx,alphamap_pars_fragment:qx,alphatest_fragment:$x,alphatest_pars_fragment:Yx,aomap_fragment:jx,aomap_pars_fragment:Zx,batching_pars_vertex:Jx,batching_vertex:Kx,begin_vertex:Qx,beginnormal_vertex:e_,bsdfs:t_,iridescence_fragment:n_,bumpmap_pars_fragment:i_,clipping_planes_fragment:s_,clipping_planes_pars_fragment:r_,clipping_planes_pars_vertex:o_,clipping_planes_vertex:a_,color_fragment:l_,color_pars_fragment:c_,color_pars_vertex:h_,color_vertex:u_,common:d_,defaultnormal_vertex:f_,displacementmap_pars_vertex:p_,displacementmap_vertex:m_,emissivemap_fragment:g_,emissivemap_pars_fragment:y_,colorspace_fragment:x_,colorspace_pars_fragment:__,envmap_fragment:v_,envmap_common_pars_fragment:b_,envmap_pars_fragment:M_,envmap_pars_vertex:S_,envmap_physical_pars_fragment:D_,envmap_vertex:w_,fog_vertex:T_,fog_pars_vertex:A_,fog_fragment:E_,fog_pars_fragment:C_,gradientmap_pars_fragment:R_,lightmap_pars_fragment:P_,lights_lambert_fragment:I_,lights_lambert_pars_fragment:L_,lights_pars_begin:N_,lights_toon_fragment:O_,lights_toon_pars_fragment:U_,lights_phong_fragment:F_,lights_phong_pars_fragment:B_,lights_physical_fragment:k_,lights_physical_pars_fragment:z_,lights_fragment_begin:V_,lights_fragment_maps:G_,lights_fragment_end:H_,lightprobes_pars_fragment:W_,logdepthbuf_fragment:X_,logdepthbuf_pars_fragment:q_,logdepthbuf_pars_vertex:$_,logdepthbuf_vertex:Y_,map_fragment:j_,map_pars_fragment:Z_,map_particle_fragment:J_,map_particle_pars_fragment:K_,metalnessmap_fragment:Q_,metalnessmap_pars_fragment:ev,morphinstance_vertex:tv,morphcolor_vertex:nv,morphnormal_vertex:iv,morphtarget_pars_vertex:sv,morphtarget_vertex:rv,normal_fragment_begin:ov,normal_fragment_maps:av,normal_pars_fragment:lv,normal_pars_vertex:cv,normal_vertex:hv,normalmap_pars_fragment:uv,clearcoat_normal_fragment_begin:dv,clearcoat_normal_fragment_maps:fv,clearcoat_pars_fragment:pv,iridescence_pars_fragment:mv,opaque_fragment:gv,packing:yv,premultiplied_alpha_fragment:xv,project_vertex:_v,dithering_fragment:vv,dithering_pars_fragment:bv,roughnessmap_fragment:Mv,roughnessmap_pars_fragment:Sv,shadowmap_pars_fragment:wv,shadowmap_pars_vertex:Tv,shadowmap_vertex:Av,shadowmask_pars_fragment:Ev,skinbase_vertex:Cv,skinning_pars_vertex:Rv,skinning_vertex:Pv,skinnormal_vertex:Iv,specularmap_fragment:Lv,specularmap_pars_fragment:Nv,tonemapping_fragment:Dv,tonemapping_pars_fragment:Ov,transmission_fragment:Uv,transmission_pars_fragment:Fv,uv_pars_fragment:Bv,uv_pars_vertex:kv,uv_vertex:zv,worldpos_vertex:Vv,background_vert:Gv,background_frag:Hv,backgroundCube_vert:Wv,backgroundCube_frag:Xv,cube_vert:qv,cube_frag:$v,depth_vert:Yv,depth_frag:jv,distance_vert:Zv,distance_frag:Jv,equirect_vert:Kv,equirect_frag:Qv,linedashed_vert:eb,linedashed_frag:tb,meshbasic_vert:nb,meshbasic_frag:ib,meshlambert_vert:sb,meshlambert_frag:rb,meshmatcap_vert:ob,meshmatcap_frag:ab,meshnormal_vert:lb,meshnormal_frag:cb,meshphong_vert:hb,meshphong_frag:ub,meshphysical_vert:db,meshphysical_frag:fb,meshtoon_vert:pb,meshtoon_frag:mb,points_vert:gb,points_frag:yb,shadow_vert:xb,shadow_frag:_b,sprite_vert:vb,sprite_frag:bb},ge={common:{diffuse:{value:new De(16777215)},opacity:{value:1},map:{value:null},mapTransform:{value:new Ue},alphaMap:{value:null},alphaMapTransform:{value:new Ue},alphaTest:{value:0}},specularmap:{specularMap:{value:null},specularMapTransform:{value:new Ue}},envmap:{envMap:{value:null},envMapRotation:{value:new Ue},reflectivity:{value:1},ior:{value:1.5},refractionRatio:{value:.98},dfgLUT:{value:null}},aomap:{aoMap:{value:null},aoMapIntensity:{value:1},aoMapTransform:{value:new Ue}},lightmap:{lightMap:{value:null},lightMapIntensity:{value:1},lightMapTransform:{value:new Ue}},bumpmap:{bumpMap:{value:null},bumpMapTransform:{value:new Ue},bumpScale:{value:1}},normalmap:{normalMap:{value:null},normalMapTransform:{value:new Ue},normalScale:{value:new _e(1,1)}},displacementmap:{displacementMap:{value:null},displacementMapTransform:{value:new Ue},displacementScale:{value:1},displacementBias:{value:0}},emissivemap:{emissiveMap:{value:null},emissiveMapTransform:{value:new Ue}},metalnessmap:{metalnessMap:{value:null},metalnessMapTransform:{value:new Ue}},roughnessmap:{roughnessMap:{value:null},roughnessMapTransform:{value:new Ue}},gradientmap:{gradientMap:{value:null}},fog:{fogDensity:{value:25e-5},fogNear:{value:1},fogFar:{value:2e3},fogColor:{value:new De(16777215)}},lights:{ambientLightColor:{value:[]},lightProbe:{value:[]},sunLights:{value:[],properties:{direction:{},color:{}}},sunLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},sunShadowMatrix:{value:[]},sunShadowCascade:{value:[]},directionalLights:{value:[],properties:{direction:{},color:{}}},directionalLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},directionalShadowMatrix:{value:[]},spotLights:{value:[],properties:{color:{},position:{},direction:{},distance:{},coneCos:{},penumbraCos:{},decay:{}}},spotLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},spotLightMap:{value:[]},spotLightMatrix:{value:[]},pointLights:{value:[],properties:{color:{},position:{},decay:{},distance:{}}},pointLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{},shadowCameraNear:{},shadowCameraFar:{}}},pointShadowMatrix:{value:[]},hemisphereLights:{value:[],properties:{direction:{},skyColor:{},groundColor:{}}},rectAreaLights:{value:[],properties:{color:{},position:{},width:{},height:{}}},ltc_1:{value:null},ltc_2:{value:null},probesSH:{value:[]},probesMin:{value:[]},probesMax:{value:[]},probesResolution:{value:[]}},points:{diffuse:{value:new De(16777215)},opacity:{value:1},size:{value:1},scale:{value:1},map:{value:null},alphaMap:{value:null},alphaMapTransform:{value:new Ue},alphaTest:{value:0},uvTransform:{value:new Ue}},sprite:{diffuse:{value:new De(16777215)},opacity:{value:1},center:{value:new _e(.5,.5)},rotation:{value:0},map:{value:null},mapTransform:{value:new Ue},alphaMap:{value:null},alphaMapTransform:{value:new Ue},alphaTest:{value:0}}},di={basic:{uniforms:an([ge.common,ge.specularmap,ge.envmap,ge.aomap,ge.lightmap,ge.fog]),vertexShader:We.meshbasic_vert,fragmentShader:We.meshbasic_frag},lambert:{uniforms:an([ge.common,ge.specularmap,ge.envmap,ge.aomap,ge.lightmap,ge.emissivemap,ge.bumpmap,ge.normalmap,ge.displacementmap,ge.fog,ge.lights,{emissive:{value:new De(0)},envMapIntensity:{value:1}}]),vertexShader:We.meshlambert_vert,fragmentShader:We.meshlambert_frag},phong:{uniforms:an([ge.common,ge.specularmap,ge.envmap,ge.aomap,ge.lightmap,ge.emissivemap,ge.bumpmap,ge.normalmap,ge.displacementmap,ge.fog,ge.lights,{emissive:{value:new De(0)},specular:{value:new De(1118481)},shininess:{value:30},envMapIntensity:{value:1}}]),vertexShader:We.meshphong_vert,fragmentShader:We.meshphong_frag},standard:{uniforms:an([ge.common,ge.envmap,ge.aomap,ge.lightmap,ge.emissivemap,ge.bumpmap,ge.normalmap,ge.displacementmap,ge.roughnessmap,ge.metalnessmap,ge.fog,ge.lights,{emissive:{value:new De(0)},roughness:{value:1},metalness:{value:0},envMapIntensity:{value:1}}]),vertexShader:We.meshphysical_vert,fragmentShader:We.meshphysical_frag},toon:{uniforms:an([ge.common,ge.aomap,ge.lightmap,ge.emissivemap,ge.bumpmap,ge.normalmap,ge.displacementmap,ge.gradientmap,ge.fog,ge.lights,{emissive:{value:new De(0)}}]),vertexShader:We.meshtoon_vert,fragmentShader:We.meshtoon_frag},matcap:{uniforms:an([ge.common,ge.bumpmap,ge.normalmap,ge.displacementmap,ge.fog,{matcap:{value:null}}]),vertexShader:We.meshmatcap_vert,fragmentShader:We.meshmatcap_frag},points:{uniforms:an([ge.points,ge.fog]),vertexShader:We.points_vert,fragmentShader:We.points_frag},dashed:{uniforms:an([ge.common,ge.fog,{scale:{value:1},dashSize:{value:1},totalSize:{value:2}}]),vertexShader:We.linedashed_vert,fragmentShader:We.linedashed_frag},depth:{uniforms:an([ge.common,ge.displacementmap]),vertexShader:We.depth_vert,fragmentShader:We.depth_frag},normal:{uniforms:an([ge.common,ge.bumpmap,ge.normalmap,ge.displacementmap,{opacity:{value:1}}]),vertexShader:We.meshnormal_vert,fragmentShader:We.meshnormal_frag},sprite:{uniforms:an([ge.sprite,ge.fog]),vertexShader:We.sprite_vert,fragmentShader:We.sprite_frag},background:{uniforms:{uvTransform:{value:new Ue},t2D:{value:null},backgroundIntensity:{value:1}},vertexShader:We.background_vert,fragmentShader:We.background_frag},backgroundCube:{uniforms:{envMap:{value:null},backgroundBlurriness:{value:0},backgroundIntensity:{value:1},backgroundRotation:{value:new Ue}},vertexShader:We.backgroundCube_vert,fragmentShader:We.backgroundCube_frag},cube:{uniforms:{tCube:{value:null},tFlip:{value:-1},opacity:{value:1}},vertexShader:We.cube_vert,fragmentShader:We.cube_frag},equirect:{uniforms:{tEquirect:{value:null}},vertexShader:We.equirect_vert,fragmentShader:We.equirect_frag},distance:{uniforms:an([ge.common,ge.displacementmap,{referencePosition:{value:new C},nearDistance:{value:1},farDistance:{value:1e3}}]),vertexShader:We.distance_vert,fragmentShader:We.distance_frag},shadow:{uniforms:an([ge.lights,ge.fog,{color:{value:new De(0)},opacity:{value:1}}]),vertexShader:We.shadow_vert,fragmentShader:We.shadow_frag}};di.physical={uniforms:an([di.standard.uniforms,{clearcoat:{value:0},clearcoatMap:{value:null},clearcoatMapTransform:{value:new Ue},clearcoatNormalMap:{value:null},clearcoatNormalMapTransform:{value:new Ue},clearcoatNormalScale:{value:new _e(1,1)},clearcoatRoughness:{value:0},clearcoatRoughnessMap:{value:null},clearcoatRoughnessMapTransform:{value:new Ue},diffuseRoughness:{value:0},diffuseRoughnessMap:{value:null},diffuseRoughnessMapTransform:{value:new Ue},dispersion:{value:0},retroreflectivity:{value:0},iridescence:{value:0},iridescenceMap:{value:null},iridescenceMapTransform:{value:new Ue},iridescenceIOR:{value:1.3},iridescenceThicknessMinimum:{value:100},iridescenceThicknessMaximum:{value:400},iridescenceThicknessMap:{value:null},iridescenceThicknessMapTransform:{value:new Ue},sheen:{value:0},sheenColor:{value:new De(0)},sheenColorMap:{value:null},sheenColorMapTransform:{value:new Ue},sheenRoughness:{value:1},sheenRoughnessMap:{value:null},sheenRoughnessMapTransform:{value:new Ue},transmission:{value:0},transmissionMap:{value:null},transmissionMapTransform:{value:new Ue},transmissionSamplerSize:{value:new _e},transmissionSamplerMap:{value:null},thickness:{value:0},thicknessMap:{value:null},thicknessMapTransform:{value:new Ue},attenuationDistance:{value:0},attenuationColor:{value:new De(0)},specularColor:{value:new De(1,1,1)},specularColorMap:{value:null},specularColorMapTransform:{value:new Ue},specularIntensity:{value:1},specularIntensityMap:{value:null},specularIntensityMapTransform:{value:new Ue},anisotropyVector:{value:new _e},anisotropyMap:{value:null},anisotropyMapTransform:{value:new Ue}}]),vertexShader:We.meshphysical_vert,fragmentShader:We.meshphysical_frag};var Kl={r:0,b:0,g:0},Mb=new Le,Am=new Ue;Am.set(-1,0,0,0,1,0,0,0,1);function Sb(i,e,t,n,s,r){let o=new De(0),a=s===!0?0:1,l,c,h=null,u=0,d=null;function f(x){let b=x.isScene===!0?x.background:null;if(b&&b.isTexture){let _=x.backgroundBlurriness>0;b=e.get(b,_)}return b}function p(x){let b=!1,_=f(x);_===null?m(o,a):_&&_.isColor&&(m(_,1),b=!0);let M=i.xr.getEnvironmentBlendMode();M==="additive"?t.buffers.color.setClear(0,0,0,1,r):M==="alpha-blend"&&t.buffers.color.setClear(0,0,0,0,r),(i.autoClear||b)&&(t.buffers.depth.setTest(!0),t.buffers.depth.setMask(!0),t.buffers.color.setMask(!0),i.clear(i.autoClearColor,i.autoClearDepth,i.autoClearStencil))}function v(x,b){let _=f(b);_&&_.isCubeTexture?(c===void 0&&(c=new Ke(new Ks(1,1,1),new on({name:"BackgroundCubeMaterial",uniforms:gs(di.backgroundCube.uniforms),vertexShader:di.backgroundCube.vertexShader,fragmentShader:di.backgroundCube.fragmentShader,side:Zt,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),c.geometry.deleteAttribute("normal"),c.geometry.deleteAttribute("uv"),c.onBeforeRender=function(M,A,y){this.matrixWorld.copyPosition(y.matrixWorld)},Object.defineProperty(c.material,"envMap",{get:function(){return this.uniforms.envMap.value}}),n.update(c)),c.material.uniforms.envMap.value=_,c.material.uniforms.backgroundBlurriness.value=b.backgroundBlurriness,c.material.uniforms.backgroundIntensity.value=b.backgroundIntensity,c.material.uniforms.backgroundRotation.value.setFromMatrix4(Mb.makeRotationFromEuler(b.backgroundRotation)).transpose(),_.isRenderTargetTexture===!1&&c.material.uniforms.backgroundRotation.value.premultiply(Am),c.material.toneMapped=$e.getTransfer(_.colorSpace)!==ht,(h!==_||u!==_.version||d!==i.toneMapping)&&(c.material.needsUpdate=!0,h=_,u=_.version,d=i.toneMapping),c.layers.enableAll(),x.unshift(c,c.geometry,c.material,0,0,null)):_&&_.isTexture&&(l===void 0&&(l=new Ke(new In(2,2),new on({name:"BackgroundMaterial",uniforms:gs(di.background.uniforms),vertexShader:di.background.vertexShader,fragmentShader:di.background.fragmentShader,side:Nn,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),l.geometry.deleteAttribute("normal"),Object.defineProperty(l.material,"map",{get:function(){return this.uniforms.t2D.value}}),n.update(l)),l.material.uniforms.t2D.value=_,l.material.uniforms.backgroundIntensity.value=b.backgroundIntensity,l.material.toneMapped=$e.getTransfer(_.colorSpace)!==ht,_.matrixAutoUpdate===!0&&_.updateMatrix(),l.material.uniforms.uvTransform.value.copy(_.matrix),(h!==_||u!==_.version||d!==i.toneMapping)&&(l.material.needsUpdate=!0,h=_,u=_.version,d=i.toneMapping),l.layers.enableAll(),x.unshift(l,l.geometry,l.material,0,0,null))}function m(x,b){x.getRGB(Kl,Zu(i)),t.buffers.color.setClear(Kl.r,Kl.g,Kl.b,b,r)}function g(){c!==void 0&&(c.geometry.dispose(),c.material.dispose(),c=void 0),l!==void 0&&(l.geometry.dispose(),l.material.dispose(),l=void 0)}return{getClearColor:function(){return o},setClearColor:function(x,b=1){o.set(x),a=b,m(o,a)},getClearAlpha:function(){return a},setClearAlpha:function(x){a=x,m(o,a)},render:p,addToRenderList:v,dispose:g}}function wb(i,e){let t=i.getParameter(i.MAX_VERTEX_ATTRIBS),n={},s=d(null),r=s,o=!1;function a(R,L,O,I,k){let H=!1,W=u(R,I,O,L);r!==W&&(r=W,c(r.object)),H=f(R,I,O,k),H&&p(R,I,O,k),k!==null&&e.update(k,i.ELEMENT_ARRAY_BUFFER),(H||o)&&(o=!1,_(R,L,O,I),k!==null&&i.bindBuffer(i.ELEMENT_ARRAY_BUFFER,e.get(k).buffer))}function l(){return i.createVertexArray()}function c(R){return i.bindVertexArray(R)}function h(R){return i.deleteVertexArray(R)}function u(R,L,O,I){let k=I.wireframe===!0,H=n[L.id];H===void 0&&(H={},n[L.id]=H);let W=R.isInstancedMesh===!0?R.id:0,te=H[W];te===void 0&&(te={},H[W]=te);let q=te[O.id];q===void 0&&(q={},te[O.id]=q);let Q=q[k];return Q===void 0&&(Q=d(l()),q[k]=Q),Q}function d(R){let L=[],O=[],I=[];for(let k=0;k<t;k++)L[k]=0,O[k]=0,I[k]=0;return{geometry:null,program:null,wireframe:!1,newAttributes:L,enabledAttributes:O,attributeDivisors:I,object:R,attributes:{},index:null}}function f(R,L,O,I){let k=r.attributes,H=L.attributes,W=0,te=O.getAttributes();for(let q in te)if(te[q].location>=0){let ee=k[q],be=H[q];if(be===void 0&&(q==="instanceMatrix"&&R.instanceMatrix&&(be=R.instanceMatrix),q==="instanceColor"&&R.instanceColor&&(be=R.instanceColor)),ee===void 0||ee.attribute!==be||be&&ee.data!==be.data)return!0;W++}return r.attributesNum!==W||r.index!==I}function p(R,L,O,I){let k={},H=L.attributes,W=0,te=O.getAttributes();for(let q in te)if(te[q].location>=0){let ee=H[q];ee===void 0&&(q==="instanceMatrix"&&R.instanceMatrix&&(ee=R.instanceMatrix),q==="instanceColor"&&R.instanceColor&&(ee=R.instanceColor));let be={};be.attribute=ee,ee&&ee.data&&(be.data=ee.data),k[q]=be,W++}r.attributes=k,r.attributesNum=W,r.index=I}function v(){let R=r.newAttributes;for(let L=0,O=R.length;L<O;L++)R[L]=0}function m(R){g(R,0)}function g(R,L){let O=r.newAttributes,I=r.enabledAttributes,k=r.attributeDivisors;O[R]=1,I[R]===0&&(i.enableVertexAttribArray(R),I[R]=1),k[R]!==L&&(i.vertexAttribDivisor(R,L),k[R]=L)}function x(){let R=r.newAttributes,L=r.enabledAttributes;for(let O=0,I=L.length;O<I;O++)L[O]!==R[O]&&(i.disableVertexAttribArray(O),L[O]=0)}function b(R,L,O,I,k,H,W){W===!0?i.vertexAttribIPointer(R,L,O,k,H):i.vertexAttribPointer(R,L,O,I,k,H)}function _(R,L,O,I){v();let k=I.attributes,H=O.getAttributes(),W=L.defaultAttributeValues;for(let te in H){let q=H[te];if(q.location>=0){let Q=k[te];if(Q===void 0&&(te==="instanceMatrix"&&R.instanceMatrix&&(Q=R.instanceMatrix),te==="instanceColor"&&R.instanceColor&&(Q=R.instanceColor)),Q!==void 0){let ee=Q.normalized,be=Q.itemSize,Oe=e.get(Q);if(Oe===void 0)continue;let Z=Oe.buffer,he=Oe.type,ve=Oe.bytesPerElement,Ce=he===i.INT||he===i.UNSIGNED_INT||Q.gpuType===gl;if(Q.isInterleavedBufferAttribute){let pe=Q.data,Fe=pe.isInterleavedBuffer===!0?pe.stride:pe.itemSize,Rt=Q.offset;if(pe.isInstancedInterleavedBuffer||pe.isInstancedBufferAttribute){for(let Pe=0;Pe<q.locationSize;Pe++)g(q.location+Pe,pe.meshPerAttribute);R.isInstancedMesh!==!0&&I._maxInstanceCount===void 0&&(I._maxInstanceCount=pe.meshPerAttribute*pe.count)}else for(let Pe=0;Pe<q.locationSize;Pe++)m(q.location+Pe);i.bindBuffer(i.ARRAY_BUFFER,Z);for(let Pe=0;Pe<q.locationSize;Pe++)b(q.location+Pe,be/q.locationSize,he,ee,Fe*ve,(Rt+be/q.locationSize*Pe)*ve,Ce)}else{if(Q.isInstancedBufferAttribute){for(let pe=0;pe<q.locationSize;pe++)g(q.location+pe,Q.meshPerAttribute);R.isInstancedMesh!==!0&&I._maxInstanceCount===void 0&&(I._maxInstanceCount=Q.meshPerAttribute*Q.count)}else for(let pe=0;pe<q.locationSize;pe++)m(q.location+pe);i.bindBuffer(i.ARRAY_BUFFER,Z);for(let pe=0;pe<q.locationSize;pe++)b(q.location+pe,be/q.locationSize,he,ee,be*ve,be/q.locationSize*pe*ve,Ce)}}else if(W!==void 0){let ee=W[te];if(ee!==void 0)switch(ee.length){case 2:i.vertexAttrib2fv(q.location,ee);break;case 3:i.vertexAttrib3fv(q.location,ee);break;case 4:i.vertexAttrib4fv(q.location,ee);break;default:i.vertexAttrib1fv(q.location,ee)}}}}x()}function M(){N();for(let R in n){let L=n[R];for(let O in L){let I=L[O];for(let k in I){let H=I[k];for(let W in H)h(H[W].object),delete H[W];delete I[k]}}delete n[R]}}function A(R){if(n[R.id]===void 0)return;let L=n[R.id];for(let O in L){let I=L[O];for(let k in I){let H=I[k];for(let W in H)h(H[W].object),delete H[W];delete I[k]}}delete n[R.id]}function y(R){for(let L in n){let O=n[L];for(let I in O){let k=O[I];if(k[R.id]===void 0)continue;let H=k[R.id];for(let W in H)h(H[W].object),delete H[W];delete k[R.id]}}}function S(R){for(let L in n){let O=n[L],I=R.isInstancedMesh===!0?R.id:0,k=O[I];if(k!==void 0){for(let H in k){let W=k[H];for(let te in W)h(W[te].object),delete W[te];delete k[H]}delete O[I],Object.keys(O).length===0&&delete n[L]}}}function N(){E(),o=!0,r!==s&&(r=s,c(r.object))}function E(){s.geometry=null,s.program=null,s.wireframe=!1}return{setup:a,reset:N,resetDefaultState:E,dispose:M,releaseStatesOfGeometry:A,releaseStatesOfObject:S,releaseStatesOfProgram:y,initAttributes:v,enableAttribute:m,disableUnusedAttributes:x}}function Tb(i,e,t){let n;function s(l){n=l}function r(l,c){i.drawArrays(n,l,c),t.update(c,n,1)}function o(l,c,h){h!==0&&(i.drawArraysInstanced(n,l,c,h),t.update(c,n,h))}function a(l,c,h){if(h===0)return;e.get("WEBGL_multi_draw").multiDrawArraysWEBGL(n,l,0,c,0,h);let d=0;for(let f=0;f<h;f++)d+=c[f];t.update(d,n,1)}this.setMode=s,this.render=r,this.renderInstances=o,this.renderMultiDraw=a}function Ab(i,e,t,n){let s;function r(){if(s!==void 0)return s;if(e.has("EXT_texture_filter_anisotropic")===!0){let y=e.get("EXT_texture_filter_anisotropic");s=i.getParameter(y.MAX_TEXTURE_MAX_ANISOTROPY_EXT)}else s=0;return s}function o(y){return!(y!==Rn&&n.convert(y)!==i.getParameter(i.IMPLEMENTATION_COLOR_READ_FORMAT))}function a(y){let S=y===Qn&&(e.has("EXT_color_buffer_half_float")||e.has("EXT_color_buffer_float"));return!(y!==vn&&y!==Cn&&!S&&n.convert(y)!==i.getParameter(i.IMPLEMENTATION_COLOR_READ_TYPE))}function l(y){if(y==="highp"){if(i.getShaderPrecisionFormat(i.VERTEX_SHADER,i.HIGH_FLOAT).precision>0&&i.getShaderPrecisionFormat(i.FRAGMENT_SHADER,i.HIGH_FLOAT).precision>0)return"highp";y="mediump"}return y==="mediump"&&i.getShaderPrecisionFormat(i.VERTEX_SHADER,i.MEDIUM_FLOAT).precision>0&&i.getShaderPrecisionFormat(i.FRAGMENT_SHADER,i.MEDIUM_FLOAT).precision>0?"mediump":"lowp"}let c=t.precision!==void 0?t.precision:"highp",h=l(c);h!==c&&(Re("WebGLRenderer:",c,"not supported, using",h,"instead."),c=h);let u=t.reversedDepthBuffer===!0&&e.has("EXT_clip_control"),d=t.logarithmicDepthBuffer===!0&&u===!1;t.reversedDepthBuffer===!0&&u===!1&&Re("WebGLRenderer: Unable to use reversed depth buffer due to missing EXT_clip_control extension. Fallback to default depth buffer."),t.logarithmicDepthBuffer===!0&&u===!0&&Re("WebGLRenderer: Logarithmic depth buffer is ignored when reversed depth buffer is enabled.");let f=i.getParameter(i.MAX_TEXTURE_IMAGE_UNITS),p=i.getParameter(i.MAX_VERTEX_TEXTURE_IMAGE_UNITS),v=i.getParameter(i.MAX_TEXTURE_SIZE),m=i.getParameter(i.MAX_CUBE_MAP_TEXTURE_SIZE),g=i.getParameter(i.MAX_VERTEX_ATTRIBS),x=i.getParameter(i.MAX_VERTEX_UNIFORM_VECTORS),b=i.getParameter(i.MAX_VARYING_VECTORS),_=i.getParameter(i.MAX_FRAGMENT_UNIFORM_VECTORS),M=i.getParameter(i.MAX_SAMPLES),A=i.getParameter(i.SAMPLES);return{isWebGL2:!0,getMaxAnisotropy:r,getMaxPrecision:l,textureFormatReadable:o,textureTypeReadable:a,precision:c,logarithmicDepthBuffer:d,reversedDepthBuffer:u,maxTextures:f,maxVertexTextures:p,maxTextureSize:v,maxCubemapSize:m,maxAttributes:g,maxVertexUniforms:x,maxVaryings:b,maxFragmentUniforms:_,maxSamples:M,samples:A}}function Eb(i){let e=this,t=null,n=0,s=!1,r=!1,o=new St,a=new Ue,l={value:null,needsUpdate:!1};this.uniform=l,this.numPlanes=0,this.numIntersection=0,this.init=function(u,d){let f=u.length!==0||d||n!==0||s;return s=d,n=u.length,f},this.beginShadows=function(){r=!0,h(null)},this.endShadows=function(){r=!1},this.setGlobalState=function(u,d){t=h(u,d,0)},this.setState=function(u,d,f){let p=u.clippingPlanes,v=u.clipIntersection,m=u.clipShadows,g=i.get(u);if(!s||p===null||p.length===0||r&&!m)r?h(null):c();else{let x=r?0:n,b=x*4,_=g.clippingState||null;l.value=_,_=h(p,d,b,f);for(let M=0;M!==b;++M)_[M]=t[M];g.clippingState=_,this.numIntersection=v?this.numPlanes:0,this.numPlanes+=x}};function c(){l.value!==t&&(l.value=t,l.needsUpdate=n>0),e.numPlanes=n,e.numIntersection=0}function h(u,d,f,p){let v=u!==null?u.length:0,m=null;if(v!==0){if(m=l.value,p!==!0||m===null){let g=f+v*4,x=d.matrixWorldInverse;a.getNormalMatrix(x),(m===null||m.length<g)&&(m=new Float32Array(g));for(let b=0,_=f;b!==v;++b,_+=4)o.copy(u[b]).applyMatrix4(x,a),o.normal.toArray(m,_),m[_+3]=o.constant}l.value=m,l.needsUpdate=!0}return e.numPlanes=v,e.numIntersection=0,m}}var Io=class extends gn{constructor(e=1,t={}){super(e,e,t),this.isWebGLCubeRenderTarget=!0;let n={width:e,height:e,depth:1},s=[n,n,n,n,n,n];this.texture=new oo(s),this._setTextureOptions(t),this.texture.isRenderTargetTexture=!0}fromEquirectangularTexture(e,t){this.texture.type=t.type,this.texture.colorSpace=t.colorSpace,this.texture.generateMipmaps=t.generateMipmaps,this.texture.minFilter=t.minFilter,this.texture.magFilter=t.magFilter;let n={uniforms:{tEquirect:{value:null}},vertexShader:`

				varying vec3 vWorldDirection;

				vec3 transformDirection( in vec3 dir, in mat4 matrix ) {

					return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );

				}

				void main() {

					vWorldDirection = transformDirection( position, modelMatrix );

					#include <begin_vertex>
					#include <project_vertex>

				}
			`,fragmentShader:`

				uniform sampler2D tEquirect;

				varying vec3 vWorldDirection;

				#include <common>

				void main() {

					vec3 direction = normalize( vWorldDirection );

					vec2 sampleUV = equirectUv( direction );

					gl_FragColor = texture2D( tEquirect, sampleUV );

				}
			`},s=new Ks(5,5,5),r=new on({name:"CubemapFromEquirect",uniforms:gs(n.uniforms),vertexShader:n.vertexShader,fragmentShader:n.fragmentShader,side:Zt,blending:ds});r.uniforms.tEquirect.value=t;let o=new Ke(s,r),a=t.minFilter;return t.minFilter===Ei&&(t.minFilter=pn),new nr(1,10,this).update(e,o),t.minFilter=a,o.geometry.dispose(),o.material.dispose(),this}clear(e,t=!0,n=!0,s=!0){let r=e.getRenderTarget();for(let o=0;o<6;o++)e.setRenderTarget(this,o),e.clear(t,n,s);e.setRenderTarget(r)}},sm=256,Cb=3,Rb=20,Em=256,Cm=16,Pb=3,Ib=new C,Lb=new De,ec=class i{constructor(e){this._renderer=e,this._cubeSize=0,this._sourceTarget=null,this._cubeCamera=new nr(1,10,null),this._boxMesh=new Ke(new Ks(5,5,5),null),this._cubemapMaterial=null,this._equirectMaterial=null,this._blurMaterial=null,this._ggxMaterial=null,this._integrationMaterial=null}fromScene(e,t=0,n=.1,s=100,r={}){let{size:o=256,position:a=Ib}=r,l=this._renderer;this._setSize(o);let c=this._allocateTarget(),h=this._getSourceTarget(!0);t>0&&(h.texture.mipmapsAutoUpdate=!1);let u=l.autoClear,d=l.autoClearColor,f=l.autoClearDepth,p=l.autoClearStencil,v=e.background;l.autoClear=!0,l.autoClearColor=!0,l.autoClearDepth=!0,l.autoClearStencil=!0,v===null&&(e.background=l.getClearColor(Lb));let m=new nr(n,s,h);return m.position.copy(a),m.update(l,e),l.autoClear=u,l.autoClearColor=d,l.autoClearDepth=f,l.autoClearStencil=p,e.background=v,t>0&&(h.texture.mipmapsAutoUpdate=!0,this._blur(c,t)),this._applyPMREM(c),c}fromEquirectangular(e,t=null){return this._fromTexture(e,t)}fromCubemap(e,t=null){return this._fromTexture(e,t)}compileCubemapShader(){this._cubemapMaterial===null&&(this._cubemapMaterial=am(),this._compileMaterial(this._cubemapMaterial))}compileEquirectangularShader(){this._equirectMaterial===null&&(this._equirectMaterial=om(),this._compileMaterial(this._equirectMaterial))}dispose(){this._sourceTarget!==null&&this._sourceTarget.dispose(),this._cubemapMaterial!==null&&this._cubemapMaterial.dispose(),this._equirectMaterial!==null&&this._equirectMaterial.dispose(),this._blurMaterial!==null&&this._blurMaterial.dispose(),this._ggxMaterial!==null&&this._ggxMaterial.dispose(),this._integrationMaterial!==null&&this._integrationMaterial.dispose(),this._boxMesh.geometry.dispose()}static lodToRoughness(e,t){return t>0?1-Math.sqrt(1-e/t):0}_setSize(e){this._cubeSize=Math.max(sm,$u(e))}_fromTexture(e,t){e.mapping===ps||e.mapping===rr?this._setSize(e.image.length===0?sm:e.image[0].width||e.image[0].image.width):this._setSize(e.image.width/4);let n=t||this._allocateTarget();return this._textureToCubemap(e),this._applyPMREM(n),n}_allocateTarget(){let e=this._cubeSize,t=rm(e,!1,!1),n=Math.log2(e)-Cb;for(let s=0;s<=n;s++)t.texture.mipmaps.push({width:e>>s,height:e>>s});return t.texture.name="PMREM",t.texture.isPMREMTexture=!0,t}_getSourceTarget(e=!1){let t=this._cubeSize,n=this._sourceTarget;return(n===null||n.width!==t||e&&n.depthBuffer===!1)&&(n!==null&&n.dispose(),this._sourceTarget=rm(t,!0,e)),this._sourceTarget}_compileMaterial(e){this._boxMesh.material=e,this._renderer.compile(this._boxMesh,this._cubeCamera.children[0])}_renderCube(e,t,n){let s=this._boxMesh,r=this._cubeCamera;s.material=n,r.renderTarget=e,r.activeMipmapLevel=t;let o=e.width>>t;e.viewport.set(0,0,o,o),r.update(this._renderer,s),e.viewport.set(0,0,e.width,e.height)}_textureToCubemap(e){let t;e.mapping===ps||e.mapping===rr?(this._cubemapMaterial===null&&(this._cubemapMaterial=am()),t=this._cubemapMaterial,t.uniforms.flipEnvMap.value=e.isRenderTargetTexture===!1?-1:1):(this._equirectMaterial===null&&(this._equirectMaterial=om()),t=this._equirectMaterial),t.uniforms.envMap.value=e,this._renderCube(this._getSourceTarget(),0,t)}_applyPMREM(e){this._ggxMaterial===null&&(this._ggxMaterial=Nb(),this._integrationMaterial=Db());let t=this._cubeSize,n=e.texture.mipmaps.length-1,s=this._ggxMaterial.uniforms;s.envMap.value=this._sourceTarget.texture;let r=this._integrationMaterial.uniforms;r.envMap.value=this._sourceTarget.texture,r.sourceLod.value=Math.log2(t/Cm);for(let o=0;o<=n;o++){let a=i.lodToRoughness(o,n);if(o>n-Pb)r.roughness.value=a,this._renderCube(e,o,this._integrationMaterial);else{let l=a>0?Math.log2(t)+.5*Math.log2(6/(Em*Math.pow(a,4)))+.5:0;s.roughness.value=a,s.lodBias.value=l,this._renderCube(e,o,this._ggxMaterial)}}}_blur(e,t){this._blurMaterial===null&&(this._blurMaterial=Ob());let n=this._blurMaterial,s=n.uniforms,r=this._sourceTarget;s.sigma.value=Math.min(t,Math.PI)/Math.SQRT2,s.envMap.value=r.texture,this._renderCube(e,0,n),s.envMap.value=e.texture,this._renderCube(r,0,n)}};function rm(i,e,t){return new Io(i,{minFilter:Ei,generateMipmaps:e,type:Qn,colorSpace:jr,depthBuffer:t})}function Lo(i,e,t){return new on({name:i,uniforms:e,vertexShader:We.cube_vert,fragmentShader:t,side:Zt,blending:ds,depthTest:!1,depthWrite:!1})}function Nb(){return Lo("PMREMGGXConvolution",{envMap:{value:null},roughness:{value:0},lodBias:{value:0}},`

		#define GGX_SAMPLES ${Em}u

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float roughness;
		uniform float lodBias;

		#include <common>

		// Van der Corput radical inverse
		float radicalInverse_VdC( uint bits ) {

			bits = ( bits << 16u ) | ( bits >> 16u );
			bits = ( ( bits & 0x55555555u ) << 1u ) | ( ( bits & 0xAAAAAAAAu ) >> 1u );
			bits = ( ( bits & 0x33333333u ) << 2u ) | ( ( bits & 0xCCCCCCCCu ) >> 2u );
			bits = ( ( bits & 0x0F0F0F0Fu ) << 4u ) | ( ( bits & 0xF0F0F0F0u ) >> 4u );
			bits = ( ( bits & 0x00FF00FFu ) << 8u ) | ( ( bits & 0xFF00FF00u ) >> 8u );
			return float( bits ) * 2.3283064365386963e-10; // / 0x100000000

		}

		// Hammersley sequence
		vec2 hammersley( uint i, uint N ) {

			return vec2( float( i ) / float( N ), radicalInverse_VdC( i ) );

		}

		void main() {

			vec3 N = normalize( vWorldDirection );

			// For very low roughness, just sample the environment directly
			if ( roughness < 0.001 ) {

				gl_FragColor = vec4( textureLod( envMap, N, 0.0 ).rgb, 1.0 );
				return;

			}

			float alpha = roughness * roughness;
			float alpha2 = alpha * alpha;

			// Tangent space basis for VNDF sampling
			vec3 up = abs( N.z ) < 0.999 ? vec3( 0.0, 0.0, 1.0 ) : vec3( 1.0, 0.0, 0.0 );
			vec3 tangent = normalize( cross( up, N ) );
			vec3 bitangent = cross( N, tangent );

			vec3 prefilteredColor = vec3( 0.0 );
			float totalWeight = 0.0;

			for ( uint i = 0u; i < GGX_SAMPLES; i ++ ) {

				vec2 Xi = hammersley( i, GGX_SAMPLES );

				// With V = N, sample the reflected direction directly.
				float invQ = 1.0 / ( 1.0 - Xi.x + alpha2 * Xi.x );
				float NdotL = ( 1.0 - Xi.x - alpha2 * Xi.x ) * invQ;

				if ( NdotL > 0.0 ) {

					float phi = 2.0 * PI * Xi.y;
					float sinTheta = 2.0 * alpha * sqrt( Xi.x * ( 1.0 - Xi.x ) ) * invQ;
					vec3 L = N * NdotL + ( tangent * cos( phi ) + bitangent * sin( phi ) ) * sinTheta;

					// Match the source mip to the sample's solid angle. The terms
					// independent of the sample are precomputed in lodBias.
					float d = alpha2 * invQ;
					float lod = max( log2( d ) + lodBias, 0.0 );

					// Weight by NdotL for the split-sum approximation
					prefilteredColor += textureLod( envMap, L, lod ).rgb * NdotL;
					totalWeight += NdotL;

				}

			}

			gl_FragColor = vec4( prefilteredColor / totalWeight, 1.0 );

		}
	`)}function Db(){return Lo("PMREMGGXIntegration",{envMap:{value:null},roughness:{value:0},sourceLod:{value:0},sourceSize:{value:Cm}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float roughness;
		uniform float sourceLod;
		uniform int sourceSize;

		void main() {

			vec3 N = normalize( vWorldDirection );

			float alpha = roughness * roughness;
			float alpha2 = alpha * alpha;

			float texelSize = 2.0 / float( sourceSize );

			vec3 prefilteredColor = vec3( 0.0 );
			float totalWeight = 0.0;

			// Pair opposite texels: only the one in N's hemisphere contributes.
			for ( int face = 0; face < 3; face ++ ) {

				for ( int y = 0; y < sourceSize; y ++ ) {

					for ( int x = 0; x < sourceSize; x ++ ) {

						vec2 uv = ( vec2( x, y ) + 0.5 ) * texelSize - 1.0;
						vec3 texelDirection = face == 0 ? vec3( 1.0, uv ) : ( face == 1 ? vec3( uv.x, 1.0, uv.y ) : vec3( uv, 1.0 ) );

						float invDistance = inversesqrt( 1.0 + dot( uv, uv ) );
						float NdotL = dot( N, texelDirection );
						texelDirection *= NdotL < 0.0 ? - 1.0 : 1.0;
						NdotL = abs( NdotL ) * invDistance;

						// With V = N, NdotH squared is ( 1 + NdotL ) / 2. Common factors
						// in the GGX distribution and texel solid angle cancel when normalized.
						float d = 1.0 + alpha2 + ( alpha2 - 1.0 ) * NdotL;
						float weight = NdotL * invDistance * invDistance * invDistance / ( d * d );

						prefilteredColor += textureLod( envMap, texelDirection, sourceLod ).rgb * weight;
						totalWeight += weight;

					}

				}

			}

			gl_FragColor = vec4( prefilteredColor / totalWeight, 1.0 );

		}
	`)}function Ob(){return Lo("PMREMSphericalGaussianBlur",{envMap:{value:null},sigma:{value:0}},`

		#define SAMPLES ${Rb}
		#define GOLDEN_ANGLE 2.39996322973

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float sigma;

		#include <common>

		void main() {

			vec3 outputDirection = normalize( vWorldDirection );

			vec3 up = abs( outputDirection.z ) < 0.999 ? vec3( 0.0, 0.0, 1.0 ) : vec3( 1.0, 0.0, 0.0 );
			vec3 tangent = normalize( cross( up, outputDirection ) );
			vec3 bitangent = cross( outputDirection, tangent );

			// Truncate the kernel at three standard deviations or at the antipode.
			float thetaMax = min( 3.0 * sigma, PI );
			float truncation = 1.0 - exp( - 0.5 * thetaMax * thetaMax / ( sigma * sigma ) );

			vec3 accumColor = vec3( 0.0 );
			float accumWeight = 0.0;

			for ( int i = 0; i < SAMPLES; i ++ ) {

				// Stratified inverse-CDF sampling of the Gaussian, placed on a golden-angle spiral.
				float stratum = ( float( i ) + 0.5 ) / float( SAMPLES );
				float theta = sigma * sqrt( - 2.0 * log( 1.0 - stratum * truncation ) );
				float phi = float( i ) * GOLDEN_ANGLE;

				vec3 offset = cos( phi ) * tangent + sin( phi ) * bitangent;
				vec3 sampleDirection = cos( theta ) * outputDirection + sin( theta ) * offset;

				// Correct the planar sample density to solid angle.
				float weight = sin( theta ) / theta;

				accumColor += weight * textureLod( envMap, sampleDirection, 0.0 ).rgb;
				accumWeight += weight;

			}

			gl_FragColor = vec4( accumColor / accumWeight, 1.0 );

		}
	`)}function om(){return Lo("PMREMEquirectangularToCubemap",{envMap:{value:null}},`

		varying vec3 vWorldDirection;

		uniform sampler2D envMap;

		#include <common>

		void main() {

			// Average four subpixel samples to preserve small, bright features.
			vec3 direction = normalize( vWorldDirection );
			vec3 dx = dFdx( direction ) * 0.25;
			vec3 dy = dFdy( direction ) * 0.25;

			vec3 color = textureLod( envMap, equirectUv( normalize( direction - dx - dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction + dx - dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction - dx + dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction + dx + dy ) ), 0.0 ).rgb;
			gl_FragColor = vec4( color * 0.25, 1.0 );

		}
	`)}function am(){return Lo("PMREMCubemapToCubemap",{envMap:{value:null},flipEnvMap:{value:-1}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float flipEnvMap;

		void main() {

			gl_FragColor = vec4( textureCube( envMap, vec3( flipEnvMap * vWorldDirection.x, vWorldDirection.yz ) ).rgb, 1.0 );

		}
	`)}function Ub(i){let e=new WeakMap,t=new WeakMap,n=null;function s(d,f=!1){return d==null?null:f?o(d):r(d)}function r(d){if(d&&d.isTexture){let f=d.mapping;if(f===fl||f===pl)if(e.has(d)){let p=e.get(d).texture;return a(p,d.mapping)}else{let p=d.image;if(p&&p.height>0){let v=new Io(p.height);return v.fromEquirectangularTexture(i,d),e.set(d,v),d.addEventListener("dispose",c),a(v.texture,d.mapping)}else return null}}return d}function o(d){if(d&&d.isTexture&&d.isPMREMTexture!==!0){let f=d.mapping,p=f===fl||f===pl,v=f===ps||f===rr;if(p||v){let m=t.get(d),g=m!==void 0?m.texture.pmremVersion:0;if(d.isRenderTargetTexture&&d.pmremVersion!==g)return n===null&&(n=new ec(i)),m=p?n.fromEquirectangular(d,m):n.fromCubemap(d,m),m.texture.pmremVersion=d.pmremVersion,t.set(d,m),m.texture;if(m!==void 0)return m.texture;{let x=d.image;return p&&x&&x.height>0||v&&x&&l(x)?(n===null&&(n=new ec(i)),m=p?n.fromEquirectangular(d):n.fromCubemap(d),m.texture.pmremVersion=d.pmremVersion,t.set(d,m),d.addEventListener("dispose",h),m.texture):null}}}return d}function a(d,f){return f===fl?d.mapping=ps:f===pl&&(d.mapping=rr),d}function l(d){let f=0,p=6;for(let v=0;v<p;v++)d[v]!==void 0&&f++;return f===p}function c(d){let f=d.target;f.removeEventListener("dispose",c);let p=e.get(f);p!==void 0&&(e.delete(f),p.dispose())}function h(d){let f=d.target;f.removeEventListener("dispose",h);let p=t.get(f);p!==void 0&&(t.delete(f),p.dispose())}function u(){e=new WeakMap,t=new WeakMap,n!==null&&(n.dispose(),n=null)}return{get:s,dispose:u}}function Fb(i){let e={};function t(n){if(e[n]!==void 0)return e[n];let s=i.getExtension(n);return e[n]=s,s}return{has:function(n){return t(n)!==null},init:function(){t("EXT_color_buffer_float"),t("WEBGL_clip_cull_distance"),t("OES_texture_float_linear"),t("EXT_color_buffer_half_float"),t("WEBGL_multisampled_render_to_texture"),t("WEBGL_render_shared_exponent")},get:function(n){let s=t(n);return s===null&&Xr("WebGLRenderer: "+n+" extension not supported."),s}}}function Bb(i,e,t,n){let s={},r=new WeakMap,o=new FinalizationRegistry(p=>delete s[p]);function a(p){l(p.target)}function l(p){p.index!==null&&e.remove(p.index);for(let m in p.attributes)e.remove(p.attributes[m]);p.removeEventListener("dispose",a),delete s[p.id],o.unregister(p);let v=r.get(p);v&&(e.remove(v),r.delete(p)),n.releaseStatesOfGeometry(p),p.isInstancedBufferGeometry===!0&&delete p._maxInstanceCount,t.memory.geometries--}function c(p,v){return s[v.id]!==void 0||(v.addEventListener("dispose",a),s[v.id]=new WeakRef(v),o.register(v,v.id,v),t.memory.geometries++),v}function h(p){let v=p.attributes;for(let m in v)e.update(v[m],i.ARRAY_BUFFER)}function u(p){let v=p.index,m=p.attributes.position,g=0;if(m===void 0)return;let x=v!==null?v.array.length:m.array.length/3-1,b=m.count>=65535?no:to,_=new b(Math.ceil(x/3)*6,1),M=_.array;if(v!==null){let y=v.array;g=v.version;for(let S=0,N=0;S<x;S+=3){let E=y[S+0],R=y[S+1],L=y[S+2];M[N++]=E,M[N++]=R,M[N++]=R,M[N++]=L,M[N++]=L,M[N++]=E}}else{g=m.version;for(let y=0,S=0;y<x;y+=3){let N=y+0,E=y+1,R=y+2;M[S++]=N,M[S++]=E,M[S++]=E,M[S++]=R,M[S++]=R,M[S++]=N}}_.version=g;let A=r.get(p);A&&e.remove(A),r.set(p,_)}function d(p){let v=r.get(p);if(v){let m=p.index;m!==null&&v.version<m.version&&u(p)}else u(p);return r.get(p)}function f(){for(let p in s){let v=s[p].deref();v!==void 0&&l(v)}}return{get:c,update:h,getWireframeAttribute:d,dispose:f}}function kb(i,e,t){let n;function s(u){n=u}let r,o;function a(u){r=u.type,o=u.bytesPerElement}function l(u,d){i.drawElements(n,d,r,u*o),t.update(d,n,1)}function c(u,d,f){f!==0&&(i.drawElementsInstanced(n,d,r,u*o,f),t.update(d,n,f))}function h(u,d,f){if(f===0)return;e.get("WEBGL_multi_draw").multiDrawElementsWEBGL(n,d,0,r,u,0,f);let v=0;for(let m=0;m<f;m++)v+=d[m];t.update(v,n,1)}this.setMode=s,this.setIndex=a,this.render=l,this.renderInstances=c,this.renderMultiDraw=h}function zb(i){let e={geometries:0,textures:0},t={frame:0,calls:0,triangles:0,points:0,lines:0};function n(r,o,a){switch(t.calls++,o){case i.TRIANGLES:t.triangles+=a*(r/3);break;case i.LINES:t.lines+=a*(r/2);break;case i.LINE_STRIP:t.lines+=a*(r-1);break;case i.LINE_LOOP:t.lines+=a*r;break;case i.POINTS:t.points+=a*r;break;default:Ne("WebGLInfo: Unknown draw mode:",o);break}}function s(){t.calls=0,t.triangles=0,t.points=0,t.lines=0}return{memory:e,render:t,programs:null,autoReset:!0,reset:s,update:n}}function Vb(i,e,t){let n=new WeakMap,s=new Ct;function r(o,a,l){let c=o.morphTargetInfluences,h=a.morphAttributes.position||a.morphAttributes.normal||a.morphAttributes.color,u=h!==void 0?h.length:0,d=n.get(a);if(d===void 0||d.count!==u){let N=function(){y.dispose(),n.delete(a),a.removeEventListener("dispose",N)};d!==void 0&&d.texture.dispose();let f=a.morphAttributes.position!==void 0,p=a.morphAttributes.normal!==void 0,v=a.morphAttributes.color!==void 0,m=a.morphAttributes.position||[],g=a.morphAttributes.normal||[],x=a.morphAttributes.color||[],b=0;f===!0&&(b=1),p===!0&&(b=2),v===!0&&(b=3);let _=a.attributes.position.count*b,M=1;_>e.maxTextureSize&&(M=Math.ceil(_/e.maxTextureSize),_=e.maxTextureSize);let A=new Float32Array(_*M*4*u),y=new eo(A,_,M,u);y.type=Cn,y.needsUpdate=!0;let S=b*4;for(let E=0;E<u;E++){let R=m[E],L=g[E],O=x[E],I=_*M*4*E;for(let k=0;k<R.count;k++){let H=k*S;f===!0&&(s.fromBufferAttribute(R,k),A[I+H+0]=s.x,A[I+H+1]=s.y,A[I+H+2]=s.z,A[I+H+3]=0),p===!0&&(s.fromBufferAttribute(L,k),A[I+H+4]=s.x,A[I+H+5]=s.y,A[I+H+6]=s.z,A[I+H+7]=0),v===!0&&(s.fromBufferAttribute(O,k),A[I+H+8]=s.x,A[I+H+9]=s.y,A[I+H+10]=s.z,A[I+H+11]=O.itemSize===4?s.w:1)}}d={count:u,texture:y,size:new _e(_,M)},n.set(a,d),a.addEventListener("dispose",N)}if(o.isInstancedMesh===!0&&o.morphTexture!==null)l.getUniforms().setValue(i,"morphTexture",o.morphTexture,t);else{let f=0;for(let v=0;v<c.length;v++)f+=c[v];let p=a.morphTargetsRelative?1:1-f;l.getUniforms().setValue(i,"morphTargetBaseInfluence",p),l.getUniforms().setValue(i,"morphTargetInfluences",c)}l.getUniforms().setValue(i,"morphTargetsTexture",d.texture,t),l.getUniforms().setValue(i,"morphTargetsTextureSize",d.size)}return{update:r}}function Gb(i,e,t,n,s){let r=new WeakMap;function o(c){let h=s.render.frame,u=c.geometry,d=e.get(c,u);if(r.get(d)!==h&&(e.update(d),r.set(d,h)),c.isInstancedMesh&&(c.hasEventListener("dispose",l)===!1&&c.addEventListener("dispose",l),r.get(c)!==h&&(t.update(c.instanceMatrix,i.ARRAY_BUFFER),c.instanceColor!==null&&t.update(c.instanceColor,i.ARRAY_BUFFER),r.set(c,h))),c.isSkinnedMesh){let f=c.skeleton;r.get(f)!==h&&(f.update(),r.set(f,h))}return d}function a(){r=new WeakMap}function l(c){let h=c.target;h.removeEventListener("dispose",l),n.releaseStatesOfObject(h),t.remove(h.instanceMatrix),h.instanceColor!==null&&t.remove(h.instanceColor)}return{update:o,dispose:a}}var Hb={[Tu]:"LINEAR_TONE_MAPPING",[Au]:"REINHARD_TONE_MAPPING",[Eu]:"CINEON_TONE_MAPPING",[Cu]:"ACES_FILMIC_TONE_MAPPING",[Pu]:"AGX_TONE_MAPPING",[Iu]:"NEUTRAL_TONE_MAPPING",[Ru]:"CUSTOM_TONE_MAPPING"};function Wb(i,e,t,n,s,r){let o=new gn(e,t,{type:i,depthBuffer:s,stencilBuffer:r,samples:n?4:0,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,resolveDepthBuffer:!1,resolveStencilBuffer:!1}),a=null,l=null,c=null,h=new rt;h.setAttribute("position",new vt([-1,3,0,-1,-1,0,3,-1,0],3)),h.setAttribute("uv",new vt([0,2,0,0,2,0],2));let u=new Qa({uniforms:{tDiffuse:{value:null}},vertexShader:`
			precision highp float;

			uniform mat4 modelViewMatrix;
			uniform mat4 projectionMatrix;

			attribute vec3 position;
			attribute vec2 uv;

			varying vec2 vUv;

			void main() {
				vUv = uv;
				gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
			}`,fragmentShader:`
			precision highp float;

			uniform sampler2D tDiffuse;

			varying vec2 vUv;

			#include <tonemapping_pars_fragment>
			#include <colorspace_pars_fragment>

			void main() {
				gl_FragColor = texture2D( tDiffuse, vUv );

				#ifdef LINEAR_TONE_MAPPING
					gl_FragColor.rgb = LinearToneMapping( gl_FragColor.rgb );
				#elif defined( REINHARD_TONE_MAPPING )
					gl_FragColor.rgb = ReinhardToneMapping( gl_FragColor.rgb );
				#elif defined( CINEON_TONE_MAPPING )
					gl_FragColor.rgb = CineonToneMapping( gl_FragColor.rgb );
				#elif defined( ACES_FILMIC_TONE_MAPPING )
					gl_FragColor.rgb = ACESFilmicToneMapping( gl_FragColor.rgb );
				#elif defined( AGX_TONE_MAPPING )
					gl_FragColor.rgb = AgXToneMapping( gl_FragColor.rgb );
				#elif defined( NEUTRAL_TONE_MAPPING )
					gl_FragColor.rgb = NeutralToneMapping( gl_FragColor.rgb );
				#elif defined( CUSTOM_TONE_MAPPING )
					gl_FragColor.rgb = CustomToneMapping( gl_FragColor.rgb );
				#endif

				#ifdef SRGB_TRANSFER
					gl_FragColor = sRGBTransferOETF( gl_FragColor );
				#endif
			}`,depthTest:!1,depthWrite:!1}),d=new Ke(h,u),f=new tr(-1,1,1,-1,0,1),p=null,v=null,m=!1,g,x=null,b=[],_=!1;this.setSize=function(M,A){o.setSize(M,A),a!==null&&a.setSize(M,A),l!==null&&l.setSize(M,A);for(let y=0;y<b.length;y++){let S=b[y];S.setSize&&S.setSize(M,A)}},this.setEffects=function(M){b=M,_=b.length>0&&b[0].isRenderPass===!0;let A=o.width,y=o.height;b.length>0&&a===null&&(a=new gn(A,y,{type:Qn,depthBuffer:!1,stencilBuffer:!1}),l=new gn(A,y,{type:Qn,depthBuffer:!1,stencilBuffer:!1}));let S=s===!0&&b.some(N=>N.needsDepthTexture===!0);S!==(o.depthTexture!==null)&&(S===!0&&c===null&&(c=new Ai(A,y),r===!0&&(c.format=Ci,c.type=ms)),o.dispose(),o.depthTexture=S?c:null,o.resolveDepthBuffer=S,o.storeMultisampledDepthBuffer=S);for(let N=0;N<b.length;N++){let E=b[N];E.setSize&&E.setSize(A,y),S&&E.needsDepthTexture===!0&&E.setDepthTexture&&E.setDepthTexture(c)}},this.begin=function(M,A){if(m||M.toneMapping===hi&&b.length===0)return!1;if(x=A,A!==null){let y=A.width,S=A.height;(o.width!==y||o.height!==S)&&this.setSize(y,S)}return _===!1&&M.setRenderTarget(o),g=M.toneMapping,M.toneMapping=hi,!0},this.hasRenderPass=function(){return _},this.end=function(M,A){M.toneMapping=g,m=!0;let y=o,S=a;for(let N=0;N<b.length;N++){let E=b[N];E.enabled!==!1&&(E.render(M,S,y,A),E.needsSwap!==!1&&(y=S,S=S===a?l:a))}if(p!==M.outputColorSpace||v!==M.toneMapping){p=M.outputColorSpace,v=M.toneMapping,u.defines={},$e.getTransfer(p)===ht&&(u.defines.SRGB_TRANSFER="");let N=Hb[v];N&&(u.defines[N]=""),u.needsUpdate=!0}u.uniforms.tDiffuse.value=y.texture,M.setRenderTarget(x),M.render(d,f),x=null,m=!1},this.isCompositing=function(){return m},this.dispose=function(){o.dispose(),a!==null&&a.dispose(),l!==null&&l.dispose(),h.dispose(),u.dispose()}}var Rm=new mn,Pm=new Ai(1,1),Im=new lo(1),Lm=new eo,Nm=new Ya,Dm=new oo,lm=[],cm=[],hm=new Float32Array(16),um=new Float32Array(9),dm=new Float32Array(4);function cr(i,e,t){let n=i[0];if(n<=0||n>0)return i;let s=e*t,r=lm[s];if(r===void 0&&(r=new Float32Array(s),lm[s]=r),e!==0){n.toArray(r,0);for(let o=1,a=0;o!==e;++o)a+=t,i[o].toArray(r,a)}return r}function Bt(i,e){if(i.length!==e.length)return!1;for(let t=0,n=i.length;t<n;t++)if(i[t]!==e[t])return!1;return!0}function kt(i,e){for(let t=0,n=e.length;t<n;t++)i[t]=e[t]}function nc(i,e){let t=cm[e];t===void 0&&(t=new Int32Array(e),cm[e]=t);for(let n=0;n!==e;++n)t[n]=i.allocateTextureUnit();return t}function Xb(i,e){let t=this.cache;t[0]!==e&&(i.uniform1f(this.addr,e),t[0]=e)}function qb(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y)&&(i.uniform2f(this.addr,e.x,e.y),t[0]=e.x,t[1]=e.y);else{if(Bt(t,e))return;i.uniform2fv(this.addr,e),kt(t,e)}}function $b(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z)&&(i.uniform3f(this.addr,e.x,e.y,e.z),t[0]=e.x,t[1]=e.y,t[2]=e.z);else if(e.r!==void 0)(t[0]!==e.r||t[1]!==e.g||t[2]!==e.b)&&(i.uniform3f(this.addr,e.r,e.g,e.b),t[0]=e.r,t[1]=e.g,t[2]=e.b);else{if(Bt(t,e))return;i.uniform3fv(this.addr,e),kt(t,e)}}function Yb(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z||t[3]!==e.w)&&(i.uniform4f(this.addr,e.x,e.y,e.z,e.w),t[0]=e.x,t[1]=e.y,t[2]=e.z,t[3]=e.w);else{if(Bt(t,e))return;i.uniform4fv(this.addr,e),kt(t,e)}}function jb(i,e){let t=this.cache,n=e.elements;if(n===void 0){if(Bt(t,e))return;i.uniformMatrix2fv(this.addr,!1,e),kt(t,e)}else{if(Bt(t,n))return;dm.set(n),i.uniformMatrix2fv(this.addr,!1,dm),kt(t,n)}}function Zb(i,e){let t=this.cache,n=e.elements;if(n===void 0){if(Bt(t,e))return;i.uniformMatrix3fv(this.addr,!1,e),kt(t,e)}else{if(Bt(t,n))return;um.set(n),i.uniformMatrix3fv(this.addr,!1,um),kt(t,n)}}function Jb(i,e){let t=this.cache,n=e.elements;if(n===void 0){if(Bt(t,e))return;i.uniformMatrix4fv(this.addr,!1,e),kt(t,e)}else{if(Bt(t,n))return;hm.set(n),i.uniformMatrix4fv(this.addr,!1,hm),kt(t,n)}}function Kb(i,e){let t=this.cache;t[0]!==e&&(i.uniform1i(this.addr,e),t[0]=e)}function Qb(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y)&&(i.uniform2i(this.addr,e.x,e.y),t[0]=e.x,t[1]=e.y);else{if(Bt(t,e))return;i.uniform2iv(this.addr,e),kt(t,e)}}function eM(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z)&&(i.uniform3i(this.addr,e.x,e.y,e.z),t[0]=e.x,t[1]=e.y,t[2]=e.z);else{if(Bt(t,e))return;i.uniform3iv(this.addr,e),kt(t,e)}}function tM(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z||t[3]!==e.w)&&(i.uniform4i(this.addr,e.x,e.y,e.z,e.w),t[0]=e.x,t[1]=e.y,t[2]=e.z,t[3]=e.w);else{if(Bt(t,e))return;i.uniform4iv(this.addr,e),kt(t,e)}}function nM(i,e){let t=this.cache;t[0]!==e&&(i.uniform1ui(this.addr,e),t[0]=e)}function iM(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y)&&(i.uniform2ui(this.addr,e.x,e.y),t[0]=e.x,t[1]=e.y);else{if(Bt(t,e))return;i.uniform2uiv(this.addr,e),kt(t,e)}}function sM(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z)&&(i.uniform3ui(this.addr,e.x,e.y,e.z),t[0]=e.x,t[1]=e.y,t[2]=e.z);else{if(Bt(t,e))return;i.uniform3uiv(this.addr,e),kt(t,e)}}function rM(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z||t[3]!==e.w)&&(i.uniform4ui(this.addr,e.x,e.y,e.z,e.w),t[0]=e.x,t[1]=e.y,t[2]=e.z,t[3]=e.w);else{if(Bt(t,e))return;i.uniform4uiv(this.addr,e),kt(t,e)}}function ic(i){return i.version===0&&(i.compareFunction=Hu,i.needsUpdate=!0),i}function oM(i,e,t){let n=this.cache,s=t.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s);let r;this.type===i.SAMPLER_2D_SHADOW?r=ic(Pm):r=Rm,t.setTexture2D(e||r,s)}function aM(i,e,t){let n=this.cache,s=t.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s),t.setTexture3D(e||Nm,s)}function lM(i,e,t){let n=this.cache,s=t.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s);let r;this.type===i.SAMPLER_CUBE_SHADOW?r=ic(Im):r=Dm,t.setTextureCube(e||r,s)}function cM(i,e,t){let n=this.cache,s=t.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s),t.setTexture2DArray(e||Lm,s)}function hM(i){switch(i){case 5126:return Xb;case 35664:return qb;case 35665:return $b;case 35666:return Yb;case 35674:return jb;case 35675:return Zb;case 35676:return Jb;case 5124:case 35670:return Kb;case 35667:case 35671:return Qb;case 35668:case 35672:return eM;case 35669:case 35673:return tM;case 5125:return nM;case 36294:return iM;case 36295:return sM;case 36296:return rM;case 35678:case 36198:case 36298:case 36306:case 35682:return oM;case 35679:case 36299:case 36307:return aM;case 35680:case 36300:case 36308:case 36293:return lM;case 36289:case 36303:case 36311:case 36292:return cM}}function uM(i,e){i.uniform1fv(this.addr,e)}function dM(i,e){let t=cr(e,this.size,2);i.uniform2fv(this.addr,t)}function fM(i,e){let t=cr(e,this.size,3);i.uniform3fv(this.addr,t)}function pM(i,e){let t=cr(e,this.size,4);i.uniform4fv(this.addr,t)}function mM(i,e){let t=cr(e,this.size,4);i.uniformMatrix2fv(this.addr,!1,t)}function gM(i,e){let t=cr(e,this.size,9);i.uniformMatrix3fv(this.addr,!1,t)}function yM(i,e){let t=cr(e,this.size,16);i.uniformMatrix4fv(this.addr,!1,t)}function xM(i,e){i.uniform1iv(this.addr,e)}function _M(i,e){i.uniform2iv(this.addr,e)}function vM(i,e){i.uniform3iv(this.addr,e)}function bM(i,e){i.uniform4iv(this.addr,e)}function MM(i,e){i.uniform1uiv(this.addr,e)}function SM(i,e){i.uniform2uiv(this.addr,e)}function wM(i,e){i.uniform3uiv(this.addr,e)}function TM(i,e){i.uniform4uiv(this.addr,e)}function AM(i,e,t){let n=this.cache,s=e.length,r=nc(t,s);Bt(n,r)||(i.uniform1iv(this.addr,r),kt(n,r));let o;this.type===i.SAMPLER_2D_SHADOW?o=ic(Pm):o=Rm;for(let a=0;a!==s;++a)t.setTexture2D(e[a]||o,r[a])}function EM(i,e,t){let n=this.cache,s=e.length,r=nc(t,s);Bt(n,r)||(i.uniform1iv(this.addr,r),kt(n,r));for(let o=0;o!==s;++o)t.setTexture3D(e[o]||Nm,r[o])}function CM(i,e,t){let n=this.cache,s=e.length,r=nc(t,s);Bt(n,r)||(i.uniform1iv(this.addr,r),kt(n,r));let o;this.type===i.SAMPLER_CUBE_SHADOW?o=ic(Im):o=Dm;for(let a=0;a!==s;++a)t.setTextureCube(e[a]||o,r[a])}function RM(i,e,t){let n=this.cache,s=e.length,r=nc(t,s);Bt(n,r)||(i.uniform1iv(this.addr,r),kt(n,r));for(let o=0;o!==s;++o)t.setTexture2DArray(e[o]||Lm,r[o])}function PM(i){switch(i){case 5126:return uM;case 35664:return dM;case 35665:return fM;case 35666:return pM;case 35674:return mM;case 35675:return gM;case 35676:return yM;case 5124:case 35670:return xM;case 35667:case 35671:return _M;case 35668:case 35672:return vM;case 35669:case 35673:return bM;case 5125:return MM;case 36294:return SM;case 36295:return wM;case 36296:return TM;case 35678:case 36198:case 36298:case 36306:case 35682:return AM;case 35679:case 36299:case 36307:return EM;case 35680:case 36300:case 36308:case 36293:return CM;case 36289:case 36303:case 36311:case 36292:return RM}}var nd=class{constructor(e,t,n){this.id=e,this.addr=n,this.cache=[],this.type=t.type,this.setValue=hM(t.type)}},id=class{constructor(e,t,n){this.id=e,this.addr=n,this.cache=[],this.type=t.type,this.size=t.size,this.setValue=PM(t.type)}},sd=class{constructor(e){this.id=e,this.seq=[],this.map={}}setValue(e,t,n){let s=this.seq;for(let r=0,o=s.length;r!==o;++r){let a=s[r];a.setValue(e,t[a.id],n)}}},ed=/(\w+)(\])?(\[|\.)?/g;function fm(i,e){i.seq.push(e),i.map[e.id]=e}function IM(i,e,t){let n=i.name,s=n.length;for(ed.lastIndex=0;;){let r=ed.exec(n),o=ed.lastIndex,a=r[1],l=r[2]==="]",c=r[3];if(l&&(a=a|0),c===void 0||c==="["&&o+2===s){fm(t,c===void 0?new nd(a,i,e):new id(a,i,e));break}else{let u=t.map[a];u===void 0&&(u=new sd(a),fm(t,u)),t=u}}}var ar=class{constructor(e,t){this.seq=[],this.map={};let n=e.getProgramParameter(t,e.ACTIVE_UNIFORMS);for(let o=0;o<n;++o){let a=e.getActiveUniform(t,o),l=e.getUniformLocation(t,a.name);IM(a,l,this)}let s=[],r=[];for(let o of this.seq)o.type===e.SAMPLER_2D_SHADOW||o.type===e.SAMPLER_CUBE_SHADOW||o.type===e.SAMPLER_2D_ARRAY_SHADOW?s.push(o):r.push(o);s.length>0&&(this.seq=s.concat(r))}setValue(e,t,n,s){let r=this.map[t];r!==void 0&&r.setValue(e,n,s)}setOptional(e,t,n){let s=t[n];s!==void 0&&this.setValue(e,n,s)}static upload(e,t,n,s){for(let r=0,o=t.length;r!==o;++r){let a=t[r],l=n[a.id];l.needsUpdate!==!1&&a.setValue(e,l.value,s)}}static seqWithValue(e,t){let n=[];for(let s=0,r=e.length;s!==r;++s){let o=e[s];o.id in t&&n.push(o)}return n}};function pm(i,e,t){let n=i.createShader(e);return i.shaderSource(n,t),i.compileShader(n),n}var LM=37297,NM=0;function DM(i,e){let t=i.split(`
`),n=[],s=Math.max(e-6,0),r=Math.min(e+6,t.length);for(let o=s;o<r;o++){let a=o+1;n.push(`${a===e?">":" "} ${a}: ${t[o]}`)}return n.join(`
`)}var mm=new Ue;function OM(i){$e._getMatrix(mm,$e.workingColorSpace,i);let e=`mat3( ${mm.elements.map(t=>t.toFixed(4))} )`;switch($e.getTransfer(i)){case Zr:return[e,"LinearTransferOETF"];case ht:return[e,"sRGBTransferOETF"];default:return Re("WebGLProgram: Unsupported color space: ",i),[e,"LinearTransferOETF"]}}function gm(i,e,t){let n=i.getShaderParameter(e,i.COMPILE_STATUS),r=(i.getShaderInfoLog(e)||"").trim();if(n&&r==="")return"";let o=/ERROR: 0:(\d+)/.exec(r);if(o){let a=parseInt(o[1]);return t.toUpperCase()+`

`+r+`

`+DM(i.getShaderSource(e),a)}else return r}function UM(i,e){let t=OM(e);return[`vec4 ${i}( vec4 value ) {`,`	return ${t[1]}( vec4( ${t[0]} * value.rgb, value.a ) );`,"}"].join(`
`)}var FM={[Tu]:"Linear",[Au]:"Reinhard",[Eu]:"Cineon",[Cu]:"ACESFilmic",[Pu]:"AgX",[Iu]:"Neutral",[Ru]:"Custom"};function BM(i,e){let t=FM[e];return t===void 0?(Re("WebGLProgram: Unsupported toneMapping:",e),"vec3 "+i+"( vec3 color ) { return LinearToneMapping( color ); }"):"vec3 "+i+"( vec3 color ) { return "+t+"ToneMapping( color ); }"}var Ql=new C;function kM(){$e.getLuminanceCoefficients(Ql);let i=Ql.x.toFixed(4),e=Ql.y.toFixed(4),t=Ql.z.toFixed(4);return["float luminance( const in vec3 rgb ) {",`	const vec3 weights = vec3( ${i}, ${e}, ${t} );`,"	return dot( weights, rgb );","}"].join(`
`)}function zM(i){return[i.extensionClipCullDistance?"#extension GL_ANGLE_clip_cull_distance : require":"",i.extensionMultiDraw?"#extension GL_ANGLE_multi_draw : require":""].filter(Po).join(`
`)}function VM(i){let e=[];for(let t in i){let n=i[t];n!==!1&&e.push("#define "+t+" "+n)}return e.join(`
`)}function GM(i,e){let t={},n=i.getProgramParameter(e,i.ACTIVE_ATTRIBUTES);for(let s=0;s<n;s++){let r=i.getActiveAttrib(e,s),o=r.name,a=1;r.type===i.FLOAT_MAT2&&(a=2),r.type===i.FLOAT_MAT3&&(a=3),r.type===i.FLOAT_MAT4&&(a=4),t[o]={type:r.type,location:i.getAttribLocation(e,o),locationSize:a}}return t}function Po(i){return i!==""}function ym(i,e){let t=e.numSpotLightShadows+e.numSpotLightMaps-e.numSpotLightShadowsWithMaps;return i.replace(/NUM_SUN_LIGHTS/g,e.numSunLights).replace(/NUM_DIR_LIGHTS/g,e.numDirLights).replace(/NUM_SPOT_LIGHTS/g,e.numSpotLights).replace(/NUM_SPOT_LIGHT_MAPS/g,e.numSpotLightMaps).replace(/NUM_SPOT_LIGHT_COORDS/g,t).replace(/NUM_RECT_AREA_LIGHTS/g,e.numRectAreaLights).replace(/NUM_POINT_LIGHTS/g,e.numPointLights).replace(/NUM_HEMI_LIGHTS/g,e.numHemiLights).replace(/NUM_SUN_LIGHT_SHADOWS/g,e.numSunLightShadows).replace(/NUM_DIR_LIGHT_SHADOWS/g,e.numDirLightShadows).replace(/NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS/g,e.numSpotLightShadowsWithMaps).replace(/NUM_SPOT_LIGHT_SHADOWS/g,e.numSpotLightShadows).replace(/NUM_POINT_LIGHT_SHADOWS/g,e.numPointLightShadows).replace(/NUM_LIGHT_PROBE_GRIDS/g,e.numLightProbeGrids)}function xm(i,e){return i.replace(/NUM_CLIPPING_PLANES/g,e.numClippingPlanes).replace(/UNION_CLIPPING_PLANES/g,e.numClippingPlanes-e.numClipIntersection)}var HM=/^[ \t]*#include +<([\w\d./]+)>/gm;function rd(i){return i.replace(HM,WM)}function WM(i,e){let t=We[e];if(t===void 0)throw new Error("THREE.WebGLProgram: Can not resolve #include <"+e+">");return rd(t)}var XM=/#pragma unroll_loop_start\s+for\s*\(\s*int\s+i\s*=\s*(\d+)\s*;\s*i\s*<\s*(\d+)\s*;\s*i\s*\+\+\s*\)\s*{([\s\S]+?)}\s+#pragma unroll_loop_end/g;function _m(i){return i.replace(XM,qM)}function qM(i,e,t,n){let s="";for(let r=parseInt(e);r<parseInt(t);r++)s+=n.replace(/\[\s*i\s*\]/g,"[ "+r+" ]").replace(/UNROLLED_LOOP_INDEX/g,r);return s}function vm(i){let e=`precision ${i.precision} float;
	precision ${i.precision} int;
	precision ${i.precision} sampler2D;
	precision ${i.precision} samplerCube;
	precision ${i.precision} sampler3D;
	precision ${i.precision} sampler2DArray;
	precision ${i.precision} sampler2DShadow;
	precision ${i.precision} samplerCubeShadow;
	precision ${i.precision} sampler2DArrayShadow;
	precision ${i.precision} isampler2D;
	precision ${i.precision} isampler3D;
	precision ${i.precision} isamplerCube;
	precision ${i.precision} isampler2DArray;
	precision ${i.precision} usampler2D;
	precision ${i.precision} usampler3D;
	precision ${i.precision} usamplerCube;
	precision ${i.precision} usampler2DArray;
	`;return i.precision==="highp"?e+=`
#define HIGH_PRECISION`:i.precision==="mediump"?e+=`
#define MEDIUM_PRECISION`:i.precision==="lowp"&&(e+=`
#define LOW_PRECISION`),e}var $M={[vo]:"SHADOWMAP_TYPE_PCF",[ir]:"SHADOWMAP_TYPE_VSM"};function YM(i){return $M[i.shadowMapType]||"SHADOWMAP_TYPE_BASIC"}var jM={[rr]:"ENVMAP_MODE_REFRACTION"};function ZM(i){return i.envMap===!1?"ENVMAP_MODE_REFLECTION":jM[i.envMapMode]||"ENVMAP_MODE_REFLECTION"}var JM={[wu]:"ENVMAP_BLENDING_MULTIPLY",[Dp]:"ENVMAP_BLENDING_MIX",[Op]:"ENVMAP_BLENDING_ADD"};function KM(i){return i.envMap===!1?"ENVMAP_BLENDING_NONE":JM[i.combine]||"ENVMAP_BLENDING_NONE"}function QM(i,e,t,n){let s=i.getContext(),r=t.defines,o=t.vertexShader,a=t.fragmentShader,l=YM(t),c=t.envMapPMREM===!0?"ENVMAP_TYPE_PMREM":"ENVMAP_TYPE_CUBE",h=ZM(t),u=KM(t),d=zM(t),f=VM(r),p=s.createProgram(),v,m,g=t.glslVersion?"#version "+t.glslVersion+`
`:"";t.isRawShaderMaterial?(v=["#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,f].filter(Po).join(`
`),v.length>0&&(v+=`
`),m=["#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,f].filter(Po).join(`
`),m.length>0&&(m+=`
`)):(v=[vm(t),"#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,f,t.extensionClipCullDistance?"#define USE_CLIP_DISTANCE":"",t.batching?"#define USE_BATCHING":"",t.batchingColor?"#define USE_BATCHING_COLOR":"",t.instancing?"#define USE_INSTANCING":"",t.instancingColor?"#define USE_INSTANCING_COLOR":"",t.instancingMorph?"#define USE_INSTANCING_MORPH":"",t.useFog&&t.fog?"#define USE_FOG":"",t.useFog&&t.fogExp2?"#define FOG_EXP2":"",t.map?"#define USE_MAP":"",t.envMap?"#define USE_ENVMAP":"",t.envMap?"#define "+h:"",t.lightMap?"#define USE_LIGHTMAP":"",t.aoMap?"#define USE_AOMAP":"",t.bumpMap?"#define USE_BUMPMAP":"",t.normalMap?"#define USE_NORMALMAP":"",t.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",t.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",t.displacementMap?"#define USE_DISPLACEMENTMAP":"",t.emissiveMap?"#define USE_EMISSIVEMAP":"",t.anisotropy?"#define USE_ANISOTROPY":"",t.anisotropyMap?"#define USE_ANISOTROPYMAP":"",t.clearcoatMap?"#define USE_CLEARCOATMAP":"",t.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",t.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",t.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",t.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",t.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",t.specularMap?"#define USE_SPECULARMAP":"",t.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",t.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",t.roughnessMap?"#define USE_ROUGHNESSMAP":"",t.metalnessMap?"#define USE_METALNESSMAP":"",t.alphaMap?"#define USE_ALPHAMAP":"",t.alphaHash?"#define USE_ALPHAHASH":"",t.transmission?"#define USE_TRANSMISSION":"",t.transmissionMap?"#define USE_TRANSMISSIONMAP":"",t.thicknessMap?"#define USE_THICKNESSMAP":"",t.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",t.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",t.mapUv?"#define MAP_UV "+t.mapUv:"",t.alphaMapUv?"#define ALPHAMAP_UV "+t.alphaMapUv:"",t.lightMapUv?"#define LIGHTMAP_UV "+t.lightMapUv:"",t.aoMapUv?"#define AOMAP_UV "+t.aoMapUv:"",t.emissiveMapUv?"#define EMISSIVEMAP_UV "+t.emissiveMapUv:"",t.bumpMapUv?"#define BUMPMAP_UV "+t.bumpMapUv:"",t.normalMapUv?"#define NORMALMAP_UV "+t.normalMapUv:"",t.displacementMapUv?"#define DISPLACEMENTMAP_UV "+t.displacementMapUv:"",t.metalnessMapUv?"#define METALNESSMAP_UV "+t.metalnessMapUv:"",t.roughnessMapUv?"#define ROUGHNESSMAP_UV "+t.roughnessMapUv:"",t.anisotropyMapUv?"#define ANISOTROPYMAP_UV "+t.anisotropyMapUv:"",t.clearcoatMapUv?"#define CLEARCOATMAP_UV "+t.clearcoatMapUv:"",t.clearcoatNormalMapUv?"#define CLEARCOAT_NORMALMAP_UV "+t.clearcoatNormalMapUv:"",t.clearcoatRoughnessMapUv?"#define CLEARCOAT_ROUGHNESSMAP_UV "+t.clearcoatRoughnessMapUv:"",t.diffuseRoughnessMapUv?"#define DIFFUSE_ROUGHNESSMAP_UV "+t.diffuseRoughnessMapUv:"",t.iridescenceMapUv?"#define IRIDESCENCEMAP_UV "+t.iridescenceMapUv:"",t.iridescenceThicknessMapUv?"#define IRIDESCENCE_THICKNESSMAP_UV "+t.iridescenceThicknessMapUv:"",t.sheenColorMapUv?"#define SHEEN_COLORMAP_UV "+t.sheenColorMapUv:"",t.sheenRoughnessMapUv?"#define SHEEN_ROUGHNESSMAP_UV "+t.sheenRoughnessMapUv:"",t.specularMapUv?"#define SPECULARMAP_UV "+t.specularMapUv:"",t.specularColorMapUv?"#define SPECULAR_COLORMAP_UV "+t.specularColorMapUv:"",t.specularIntensityMapUv?"#define SPECULAR_INTENSITYMAP_UV "+t.specularIntensityMapUv:"",t.transmissionMapUv?"#define TRANSMISSIONMAP_UV "+t.transmissionMapUv:"",t.thicknessMapUv?"#define THICKNESSMAP_UV "+t.thicknessMapUv:"",t.vertexTangents&&t.flatShading===!1?"#define USE_TANGENT":"",t.vertexNormals?"#define HAS_NORMAL":"",t.vertexColors?"#define USE_COLOR":"",t.vertexAlphas?"#define USE_COLOR_ALPHA":"",t.vertexUv1s?"#define USE_UV1":"",t.vertexUv2s?"#define USE_UV2":"",t.vertexUv3s?"#define USE_UV3":"",t.pointsUvs?"#define USE_POINTS_UV":"",t.flatShading?"#define FLAT_SHADED":"",t.skinning?"#define USE_SKINNING":"",t.morphTargets?"#define USE_MORPHTARGETS":"",t.morphNormals&&t.flatShading===!1?"#define USE_MORPHNORMALS":"",t.morphColors?"#define USE_MORPHCOLORS":"",t.morphTargetsCount>0?"#define MORPHTARGETS_TEXTURE_STRIDE "+t.morphTextureStride:"",t.morphTargetsCount>0?"#define MORPHTARGETS_COUNT "+t.morphTargetsCount:"",t.doubleSided?"#define DOUBLE_SIDED":"",t.flipSided?"#define FLIP_SIDED":"",t.shadowMapEnabled?"#define USE_SHADOWMAP":"",t.shadowMapEnabled?"#define "+l:"",t.sizeAttenuation?"#define USE_SIZEATTENUATION":"",t.numLightProbes>0?"#define USE_LIGHT_PROBES":"",t.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",t.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 modelMatrix;","uniform mat4 modelViewMatrix;","uniform mat4 projectionMatrix;","uniform mat4 viewMatrix;","uniform mat3 normalMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;","#ifdef USE_INSTANCING","	attribute mat4 instanceMatrix;","#endif","#ifdef USE_INSTANCING_COLOR","	attribute vec3 instanceColor;","#endif","#ifdef USE_INSTANCING_MORPH","	uniform sampler2D morphTexture;","#endif","attribute vec3 position;","attribute vec3 normal;","attribute vec2 uv;","#ifdef USE_UV1","	attribute vec2 uv1;","#endif","#ifdef USE_UV2","	attribute vec2 uv2;","#endif","#ifdef USE_UV3","	attribute vec2 uv3;","#endif","#ifdef USE_TANGENT","	attribute vec4 tangent;","#endif","#if defined( USE_COLOR_ALPHA )","	attribute vec4 color;","#elif defined( USE_COLOR )","	attribute vec3 color;","#endif","#ifdef USE_SKINNING","	attribute vec4 skinIndex;","	attribute vec4 skinWeight;","#endif",`
`].filter(Po).join(`
`),m=[vm(t),"#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,f,t.useFog&&t.fog?"#define USE_FOG":"",t.useFog&&t.fogExp2?"#define FOG_EXP2":"",t.alphaToCoverage?"#define ALPHA_TO_COVERAGE":"",t.map?"#define USE_MAP":"",t.matcap?"#define USE_MATCAP":"",t.envMap?"#define USE_ENVMAP":"",t.envMap?"#define "+c:"",t.envMap?"#define "+h:"",t.envMap?"#define "+u:"",t.envMapPMREM?"#define ENVMAP_MAX_LOD "+t.envMapMaxLod+".0":"",t.envMapPMREM?"#define ENVMAP_SIZE "+t.envMapSize+".0":"",t.lightMap?"#define USE_LIGHTMAP":"",t.aoMap?"#define USE_AOMAP":"",t.bumpMap?"#define USE_BUMPMAP":"",t.normalMap?"#define USE_NORMALMAP":"",t.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",t.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",t.packedNormalMap?"#define USE_PACKED_NORMALMAP":"",t.emissiveMap?"#define USE_EMISSIVEMAP":"",t.anisotropy?"#define USE_ANISOTROPY":"",t.anisotropyMap?"#define USE_ANISOTROPYMAP":"",t.clearcoat?"#define USE_CLEARCOAT":"",t.clearcoatMap?"#define USE_CLEARCOATMAP":"",t.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",t.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",t.diffuseRoughness?"#define USE_DIFFUSE_ROUGHNESS":"",t.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",t.dispersion?"#define USE_DISPERSION":"",t.retroreflection?"#define USE_RETROREFLECTION":"",t.iridescence?"#define USE_IRIDESCENCE":"",t.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",t.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",t.specularMap?"#define USE_SPECULARMAP":"",t.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",t.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",t.roughnessMap?"#define USE_ROUGHNESSMAP":"",t.metalnessMap?"#define USE_METALNESSMAP":"",t.alphaMap?"#define USE_ALPHAMAP":"",t.alphaTest?"#define USE_ALPHATEST":"",t.alphaHash?"#define USE_ALPHAHASH":"",t.sheen?"#define USE_SHEEN":"",t.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",t.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",t.transmission?"#define USE_TRANSMISSION":"",t.transmissionMap?"#define USE_TRANSMISSIONMAP":"",t.thicknessMap?"#define USE_THICKNESSMAP":"",t.vertexTangents&&t.flatShading===!1?"#define USE_TANGENT":"",t.vertexColors||t.instancingColor?"#define USE_COLOR":"",t.vertexAlphas||t.batchingColor?"#define USE_COLOR_ALPHA":"",t.vertexUv1s?"#define USE_UV1":"",t.vertexUv2s?"#define USE_UV2":"",t.vertexUv3s?"#define USE_UV3":"",t.pointsUvs?"#define USE_POINTS_UV":"",t.gradientMap?"#define USE_GRADIENTMAP":"",t.flatShading?"#define FLAT_SHADED":"",t.doubleSided?"#define DOUBLE_SIDED":"",t.flipSided?"#define FLIP_SIDED":"",t.shadowMapEnabled?"#define USE_SHADOWMAP":"",t.shadowMapEnabled?"#define "+l:"",t.premultipliedAlpha?"#define PREMULTIPLIED_ALPHA":"",t.numLightProbes>0?"#define USE_LIGHT_PROBES":"",t.decodeVideoTexture?"#define DECODE_VIDEO_TEXTURE":"",t.decodeVideoTextureEmissive?"#define DECODE_VIDEO_TEXTURE_EMISSIVE":"",t.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",t.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 viewMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;",t.toneMapping!==hi?"#define TONE_MAPPING":"",t.toneMapping!==hi?We.tonemapping_pars_fragment:"",t.toneMapping!==hi?BM("toneMapping",t.toneMapping):"",t.dithering?"#define DITHERING":"",t.opaque?"#define OPAQUE":"",We.colorspace_pars_fragment,UM("linearToOutputTexel",t.outputColorSpace),kM(),t.useDepthPacking?"#define DEPTH_PACKING "+t.depthPacking:"",`
`].filter(Po).join(`
`)),o=rd(o),o=ym(o,t),o=xm(o,t),a=rd(a),a=ym(a,t),a=xm(a,t),o=_m(o),a=_m(a),t.isRawShaderMaterial!==!0&&(g=`#version 300 es
`,v=[d,"#define attribute in","#define varying out","#define texture2D texture"].join(`
`)+`
`+v,m=["#define varying in",t.glslVersion===Xu?"":"layout(location = 0) out highp vec4 pc_fragColor;",t.glslVersion===Xu?"":"#define gl_FragColor pc_fragColor","#define gl_FragDepthEXT gl_FragDepth","#define texture2D texture","#define textureCube texture","#define texture2DProj textureProj","#define texture2DLodEXT textureLod","#define texture2DProjLodEXT textureProjLod","#define textureCubeLodEXT textureLod","#define texture2DGradEXT textureGrad","#define texture2DProjGradEXT textureProjGrad","#define textureCubeGradEXT textureGrad"].join(`
`)+`
`+m);let x=g+v+o,b=g+m+a,_=pm(s,s.VERTEX_SHADER,x),M=pm(s,s.FRAGMENT_SHADER,b);s.attachShader(p,_),s.attachShader(p,M),t.index0AttributeName!==void 0?s.bindAttribLocation(p,0,t.index0AttributeName):t.hasPositionAttribute===!0&&s.bindAttribLocation(p,0,"position"),s.linkProgram(p);function A(E){if(i.debug.checkShaderErrors){let R=s.getProgramInfoLog(p)||"",L=s.getShaderInfoLog(_)||"",O=s.getShaderInfoLog(M)||"",I=R.trim(),k=L.trim(),H=O.trim(),W=!0,te=!0;if(s.getProgramParameter(p,s.LINK_STATUS)===!1)if(W=!1,typeof i.debug.onShaderError=="function")i.debug.onShaderError(s,p,_,M);else{let q=gm(s,_,"vertex"),Q=gm(s,M,"fragment");Ne("WebGLProgram: Shader Error "+s.getError()+" - VALIDATE_STATUS "+s.getProgramParameter(p,s.VALIDATE_STATUS)+`

Material Name: `+E.name+`
Material Type: `+E.type+`

Program Info Log: `+I+`
`+q+`
`+Q)}else I!==""?Re("WebGLProgram: Program Info Log:",I):(k===""||H==="")&&(te=!1);te&&(E.diagnostics={runnable:W,programLog:I,vertexShader:{log:k,prefix:v},fragmentShader:{log:H,prefix:m}})}s.deleteShader(_),s.deleteShader(M),y=new ar(s,p),S=GM(s,p)}let y;this.getUniforms=function(){return y===void 0&&A(this),y};let S;this.getAttributes=function(){return S===void 0&&A(this),S};let N=t.rendererExtensionParallelShaderCompile===!1;return this.isReady=function(){return N===!1&&(N=s.getProgramParameter(p,LM)),N},this.destroy=function(){n.releaseStatesOfProgram(this),s.deleteProgram(p),this.program=void 0},this.type=t.shaderType,this.name=t.shaderName,this.id=NM++,this.cacheKey=e,this.usedTimes=1,this.program=p,this.vertexShader=_,this.fragmentShader=M,this}var eS=0,od=class{constructor(){this.shaderCache=new Map,this.materialCache=new Map}update(e,t,n){let s=this._getShaderCacheForMaterial(e);return s.has(t)===!1&&(s.add(t),t.usedTimes++),s.has(n)===!1&&(s.add(n),n.usedTimes++),this}remove(e){let t=this.materialCache.get(e);for(let n of t)n.usedTimes--,n.usedTimes===0&&this.shaderCache.delete(n.code);return this.materialCache.delete(e),this}getVertexShaderStage(e){return this._getShaderStage(e.vertexShader)}getFragmentShaderStage(e){return this._getShaderStage(e.fragmentShader)}dispose(){this.shaderCache.clear(),this.materialCache.clear()}_getShaderCacheForMaterial(e){let t=this.materialCache,n=t.get(e);return n===void 0&&(n=new Set,t.set(e,n)),n}_getShaderStage(e){let t=this.shaderCache,n=t.get(e);return n===void 0&&(n=new ad(e),t.set(e,n)),n}},ad=class{constructor(e){this.id=eS++,this.code=e,this.usedTimes=0}};function tS(i){return i===Xi||i===Eo||i===Co}function nS(i,e,t,n,s,r){let o=new qs,a=new od,l=new Set,c=[],h=new Map,u=n.logarithmicDepthBuffer,d={MeshDepthMaterial:"depth",MeshDistanceMaterial:"distance",MeshNormalMaterial:"normal",MeshBasicMaterial:"basic",MeshLambertMaterial:"lambert",MeshPhongMaterial:"phong",MeshToonMaterial:"toon",MeshStandardMaterial:"physical",MeshPhysicalMaterial:"physical",MeshMatcapMaterial:"matcap",LineBasicMaterial:"basic",LineDashedMaterial:"dashed",PointsMaterial:"points",ShadowMaterial:"shadow",SpriteMaterial:"sprite"};function f(y){return l.add(y),y===0?"uv":`uv${y}`}function p(y,S,N,E,R,L){let O=E.fog,I=R.geometry,k=y.isMeshStandardMaterial||y.isMeshLambertMaterial||y.isMeshPhongMaterial?E.environment:null,H=y.isMeshStandardMaterial||y.isMeshLambertMaterial&&!y.envMap||y.isMeshPhongMaterial&&!y.envMap,W=e.get(y.envMap||k,H),te=d[y.type],q=n.precision;y.precision!==null&&(q=n.getMaxPrecision(y.precision),q!==y.precision&&Re("WebGLProgram.getParameters:",y.precision,"not supported, using",q,"instead."));let Q=I.morphAttributes.position||I.morphAttributes.normal||I.morphAttributes.color,ee=Q!==void 0?Q.length:0,be=0;I.morphAttributes.position!==void 0&&(be=1),I.morphAttributes.normal!==void 0&&(be=2),I.morphAttributes.color!==void 0&&(be=3);let Oe,Z,he,ve;if(te){let me=di[te];Oe=me.vertexShader,Z=me.fragmentShader}else{Oe=y.vertexShader,Z=y.fragmentShader;let me=a.getVertexShaderStage(y),dt=a.getFragmentShaderStage(y);a.update(y,me,dt),he=me.id,ve=dt.id}let Ce=i.getRenderTarget(),pe=i.state.buffers.depth.getReversed(),Fe=R.isInstancedMesh===!0,Rt=R.isBatchedMesh===!0,Pe=!!y.map,nt=!!y.matcap,pt=!!W,je=pt&&W.isPMREMTexture===!0,qt=!!y.aoMap,Ot=!!y.lightMap,Mn=!!y.bumpMap&&y.wireframe===!1,Tt=!!y.normalMap,si=!!y.displacementMap,zt=!!y.emissiveMap,Fn=!!y.metalnessMap,Bn=!!y.roughnessMap,kn=y.anisotropy>0,B=y.clearcoat>0,zn=y.diffuseRoughness>0,bt=y.dispersion>0,Mt=y.retroreflectivity>0,fe=y.iridescence>0,Ut=y.sheen>0,Ie=y.transmission>0,Be=kn&&!!y.anisotropyMap,P=B&&!!y.clearcoatMap,w=B&&!!y.clearcoatNormalMap,V=B&&!!y.clearcoatRoughnessMap,ne=zn&&!!y.diffuseRoughnessMap,K=fe&&!!y.iridescenceMap,re=fe&&!!y.iridescenceThicknessMap,ue=Ut&&!!y.sheenColorMap,Y=Ut&&!!y.sheenRoughnessMap,j=!!y.specularMap,ae=!!y.specularColorMap,D=!!y.specularIntensityMap,J=Ie&&!!y.transmissionMap,$=Ie&&!!y.thicknessMap,le=!!y.gradientMap,se=!!y.alphaMap,oe=y.alphaTest>0,Ae=!!y.alphaHash,He=!!y.extensions,ie=hi;y.toneMapped&&(Ce===null||Ce.isXRRenderTarget===!0)&&(ie=i.toneMapping);let Ee=je?W.isCompressedCubeTexture?W.image[0].mipmaps:W.mipmaps:null,Ge={shaderID:te,shaderType:y.type,shaderName:y.name,vertexShader:Oe,fragmentShader:Z,defines:y.defines,customVertexShaderID:he,customFragmentShaderID:ve,isRawShaderMaterial:y.isRawShaderMaterial===!0,glslVersion:y.glslVersion,precision:q,batching:Rt,batchingColor:Rt&&R._colorsTexture!==null,instancing:Fe,instancingColor:Fe&&R.instanceColor!==null,instancingMorph:Fe&&R.morphTexture!==null,outputColorSpace:Ce===null?i.outputColorSpace:Ce.isXRRenderTarget===!0?Ce.texture.colorSpace:$e.workingColorSpace,alphaToCoverage:!!y.alphaToCoverage,map:Pe,matcap:nt,envMap:pt,envMapMode:pt&&W.mapping,envMapPMREM:je,envMapMaxLod:je?Ee.length-1:null,envMapSize:je?Ee[0].width:null,aoMap:qt,lightMap:Ot,bumpMap:Mn,normalMap:Tt,displacementMap:si,emissiveMap:zt,normalMapObjectSpace:Tt&&y.normalMapType===Bp,normalMapTangentSpace:Tt&&y.normalMapType===zu,packedNormalMap:Tt&&y.normalMapType===zu&&tS(y.normalMap.format),metalnessMap:Fn,roughnessMap:Bn,anisotropy:kn,anisotropyMap:Be,clearcoat:B,clearcoatMap:P,clearcoatNormalMap:w,clearcoatRoughnessMap:V,diffuseRoughness:zn,diffuseRoughnessMap:ne,dispersion:bt,retroreflection:Mt,iridescence:fe,iridescenceMap:K,iridescenceThicknessMap:re,sheen:Ut,sheenColorMap:ue,sheenRoughnessMap:Y,specularMap:j,specularColorMap:ae,specularIntensityMap:D,transmission:Ie,transmissionMap:J,thicknessMap:$,gradientMap:le,opaque:y.transparent===!1&&y.blending===sr&&y.alphaToCoverage===!1,alphaMap:se,alphaTest:oe,alphaHash:Ae,combine:y.combine,mapUv:Pe&&f(y.map.channel),aoMapUv:qt&&f(y.aoMap.channel),lightMapUv:Ot&&f(y.lightMap.channel),bumpMapUv:Mn&&f(y.bumpMap.channel),normalMapUv:Tt&&f(y.normalMap.channel),displacementMapUv:si&&f(y.displacementMap.channel),emissiveMapUv:zt&&f(y.emissiveMap.channel),metalnessMapUv:Fn&&f(y.metalnessMap.channel),roughnessMapUv:Bn&&f(y.roughnessMap.channel),anisotropyMapUv:Be&&f(y.anisotropyMap.channel),clearcoatMapUv:P&&f(y.clearcoatMap.channel),clearcoatNormalMapUv:w&&f(y.clearcoatNormalMap.channel),clearcoatRoughnessMapUv:V&&f(y.clearcoatRoughnessMap.channel),diffuseRoughnessMapUv:ne&&f(y.diffuseRoughnessMap.channel),iridescenceMapUv:K&&f(y.iridescenceMap.channel),iridescenceThicknessMapUv:re&&f(y.iridescenceThicknessMap.channel),sheenColorMapUv:ue&&f(y.sheenColorMap.channel),sheenRoughnessMapUv:Y&&f(y.sheenRoughnessMap.channel),specularMapUv:j&&f(y.specularMap.channel),specularColorMapUv:ae&&f(y.specularColorMap.channel),specularIntensityMapUv:D&&f(y.specularIntensityMap.channel),transmissionMapUv:J&&f(y.transmissionMap.channel),thicknessMapUv:$&&f(y.thicknessMap.channel),alphaMapUv:se&&f(y.alphaMap.channel),vertexTangents:!!I.attributes.tangent&&(Tt||kn),vertexNormals:!!I.attributes.normal,vertexColors:y.vertexColors,vertexAlphas:y.vertexColors===!0&&!!I.attributes.color&&I.attributes.color.itemSize===4,pointsUvs:R.isPoints===!0&&!!I.attributes.uv&&(Pe||se),fog:!!O,useFog:y.fog===!0,fogExp2:!!O&&O.isFogExp2,flatShading:y.wireframe===!1&&(y.flatShading===!0||I.attributes.normal===void 0&&Tt===!1&&(y.isMeshLambertMaterial||y.isMeshPhongMaterial||y.isMeshStandardMaterial||y.isMeshPhysicalMaterial)),sizeAttenuation:y.sizeAttenuation===!0,logarithmicDepthBuffer:u,reversedDepthBuffer:pe,skinning:R.isSkinnedMesh===!0,hasPositionAttribute:I.attributes.position!==void 0,morphTargets:I.morphAttributes.position!==void 0,morphNormals:I.morphAttributes.normal!==void 0,morphColors:I.morphAttributes.color!==void 0,morphTargetsCount:ee,morphTextureStride:be,numSunLights:S.sun.length,numDirLights:S.directional.length,numPointLights:S.point.length,numSpotLights:S.spot.length,numSpotLightMaps:S.spotLightMap.length,numRectAreaLights:S.rectArea.length,numHemiLights:S.hemi.length,numSunLightShadows:S.sunShadowMap.length,numDirLightShadows:S.directionalShadowMap.length,numPointLightShadows:S.pointShadowMap.length,numSpotLightShadows:S.spotShadowMap.length,numSpotLightShadowsWithMaps:S.numSpotLightShadowsWithMaps,numLightProbes:S.numLightProbes,numLightProbeGrids:L.filter(me=>me.texture!==null).length,numClippingPlanes:r.numPlanes,numClipIntersection:r.numIntersection,dithering:y.dithering,shadowMapEnabled:i.shadowMap.enabled&&N.length>0,shadowMapType:i.shadowMap.type,toneMapping:ie,decodeVideoTexture:Pe&&y.map.isVideoTexture===!0&&$e.getTransfer(y.map.colorSpace)===ht,decodeVideoTextureEmissive:zt&&y.emissiveMap.isVideoTexture===!0&&$e.getTransfer(y.emissiveMap.colorSpace)===ht,premultipliedAlpha:y.premultipliedAlpha,doubleSided:y.side===wt,flipSided:y.side===Zt,useDepthPacking:y.depthPacking>=0,depthPacking:y.depthPacking||0,index0AttributeName:y.index0AttributeName,extensionClipCullDistance:He&&y.extensions.clipCullDistance===!0&&t.has("WEBGL_clip_cull_distance"),extensionMultiDraw:(He&&y.extensions.multiDraw===!0||Rt)&&t.has("WEBGL_multi_draw"),rendererExtensionParallelShaderCompile:t.has("KHR_parallel_shader_compile"),customProgramCacheKey:y.customProgramCacheKey()};return Ge.vertexUv1s=l.has(1),Ge.vertexUv2s=l.has(2),Ge.vertexUv3s=l.has(3),l.clear(),Ge}function v(y){let S=[];if(y.shaderID?S.push(y.shaderID):(S.push(y.customVertexShaderID),S.push(y.customFragmentShaderID)),y.defines!==void 0)for(let N in y.defines)S.push(N),S.push(y.defines[N]);return y.isRawShaderMaterial===!1&&(m(S,y),g(S,y),S.push(i.outputColorSpace)),S.push(y.customProgramCacheKey),S.join()}function m(y,S){y.push(S.precision),y.push(S.outputColorSpace),y.push(S.envMapMode),y.push(S.envMapPMREM),y.push(S.envMapMaxLod),y.push(S.envMapSize),y.push(S.mapUv),y.push(S.alphaMapUv),y.push(S.lightMapUv),y.push(S.aoMapUv),y.push(S.bumpMapUv),y.push(S.normalMapUv),y.push(S.displacementMapUv),y.push(S.emissiveMapUv),y.push(S.metalnessMapUv),y.push(S.roughnessMapUv),y.push(S.anisotropyMapUv),y.push(S.clearcoatMapUv),y.push(S.clearcoatNormalMapUv),y.push(S.clearcoatRoughnessMapUv),y.push(S.diffuseRoughnessMapUv),y.push(S.iridescenceMapUv),y.push(S.iridescenceThicknessMapUv),y.push(S.sheenColorMapUv),y.push(S.sheenRoughnessMapUv),y.push(S.specularMapUv),y.push(S.specularColorMapUv),y.push(S.specularIntensityMapUv),y.push(S.transmissionMapUv),y.push(S.thicknessMapUv),y.push(S.combine),y.push(S.fogExp2),y.push(S.sizeAttenuation),y.push(S.morphTargetsCount),y.push(S.numSunLights),y.push(S.numDirLights),y.push(S.numPointLights),y.push(S.numSpotLights),y.push(S.numSpotLightMaps),y.push(S.numHemiLights),y.push(S.numRectAreaLights),y.push(S.numSunLightShadows),y.push(S.numDirLightShadows),y.push(S.numPointLightShadows),y.push(S.numSpotLightShadows),y.push(S.numSpotLightShadowsWithMaps),y.push(S.numLightProbes),y.push(S.numLightProbeGrids),y.push(S.shadowMapType),y.push(S.toneMapping),y.push(S.numClippingPlanes),y.push(S.numClipIntersection),y.push(S.depthPacking)}function g(y,S){o.disableAll(),S.instancing&&o.enable(0),S.instancingColor&&o.enable(1),S.instancingMorph&&o.enable(2),S.matcap&&o.enable(3),S.envMap&&o.enable(4),S.normalMapObjectSpace&&o.enable(5),S.normalMapTangentSpace&&o.enable(6),S.clearcoat&&o.enable(7),S.iridescence&&o.enable(8),S.alphaTest&&o.enable(9),S.vertexColors&&o.enable(10),S.vertexAlphas&&o.enable(11),S.vertexUv1s&&o.enable(12),S.vertexUv2s&&o.enable(13),S.vertexUv3s&&o.enable(14),S.vertexTangents&&o.enable(15),S.anisotropy&&o.enable(16),S.alphaHash&&o.enable(17),S.batching&&o.enable(18),S.dispersion&&o.enable(19),S.retroreflection&&o.enable(24),S.diffuseRoughness&&o.enable(25),S.batchingColor&&o.enable(20),S.gradientMap&&o.enable(21),S.packedNormalMap&&o.enable(22),S.vertexNormals&&o.enable(23),y.push(o.mask),o.disableAll(),S.fog&&o.enable(0),S.useFog&&o.enable(1),S.flatShading&&o.enable(2),S.logarithmicDepthBuffer&&o.enable(3),S.reversedDepthBuffer&&o.enable(4),S.skinning&&o.enable(5),S.morphTargets&&o.enable(6),S.morphNormals&&o.enable(7),S.morphColors&&o.enable(8),S.premultipliedAlpha&&o.enable(9),S.shadowMapEnabled&&o.enable(10),S.doubleSided&&o.enable(11),S.flipSided&&o.enable(12),S.useDepthPacking&&o.enable(13),S.dithering&&o.enable(14),S.transmission&&o.enable(15),S.sheen&&o.enable(16),S.opaque&&o.enable(17),S.pointsUvs&&o.enable(18),S.decodeVideoTexture&&o.enable(19),S.decodeVideoTextureEmissive&&o.enable(20),S.alphaToCoverage&&o.enable(21),S.numLightProbeGrids>0&&o.enable(22),S.hasPositionAttribute&&o.enable(23),y.push(o.mask)}function x(y){let S=d[y.type],N;if(S){let E=di[S];N=tm.clone(E.uniforms)}else N=y.uniforms;return N}function b(y,S){let N=h.get(S);return N!==void 0?++N.usedTimes:(N=new QM(i,S,y,s),c.push(N),h.set(S,N)),N}function _(y){if(--y.usedTimes===0){let S=c.indexOf(y);c[S]=c[c.length-1],c.pop(),h.delete(y.cacheKey),y.destroy()}}function M(y){a.remove(y)}function A(){a.dispose()}return{getParameters:p,getProgramCacheKey:v,getUniforms:x,acquireProgram:b,releaseProgram:_,releaseShaderCache:M,programs:c,dispose:A}}function iS(){let i=new WeakMap;function e(o){return i.has(o)}function t(o){let a=i.get(o);return a===void 0&&(a={},i.set(o,a)),a}function n(o){i.delete(o)}function s(o,a,l){i.get(o)[a]=l}function r(){i=new WeakMap}return{has:e,get:t,remove:n,update:s,dispose:r}}function sS(i,e){return i.groupOrder!==e.groupOrder?i.groupOrder-e.groupOrder:i.renderOrder!==e.renderOrder?i.renderOrder-e.renderOrder:i.material.id!==e.material.id?i.material.id-e.material.id:i.materialVariant!==e.materialVariant?i.materialVariant-e.materialVariant:i.z!==e.z?i.z-e.z:i.id-e.id}function bm(i,e){return i.groupOrder!==e.groupOrder?i.groupOrder-e.groupOrder:i.renderOrder!==e.renderOrder?i.renderOrder-e.renderOrder:i.z!==e.z?e.z-i.z:i.id-e.id}function Mm(){let i=[],e=0,t=[],n=[],s=[];function r(){e=0,t.length=0,n.length=0,s.length=0}function o(d){let f=0;return d.isInstancedMesh&&(f+=2),d.isSkinnedMesh&&(f+=1),f}function a(d,f,p,v,m,g){let x=i[e];return x===void 0?(x={id:d.id,object:d,geometry:f,material:p,materialVariant:o(d),groupOrder:v,renderOrder:d.renderOrder,z:m,group:g},i[e]=x):(x.id=d.id,x.object=d,x.geometry=f,x.material=p,x.materialVariant=o(d),x.groupOrder=v,x.renderOrder=d.renderOrder,x.z=m,x.group=g),e++,x}function l(d,f,p,v,m,g,x){x.reversedDepth===!0&&(m=-m);let b=a(d,f,p,v,m,g);p.transmission>0?n.push(b):p.transparent===!0?s.push(b):t.push(b)}function c(d,f,p,v,m,g){let x=a(d,f,p,v,m,g);p.transmission>0?n.unshift(x):p.transparent===!0?s.unshift(x):t.unshift(x)}function h(d,f){t.length>1&&t.sort(d||sS),n.length>1&&n.sort(f||bm),s.length>1&&s.sort(f||bm)}function u(){for(let d=e,f=i.length;d<f;d++){let p=i[d];if(p.id===null)break;p.id=null,p.object=null,p.geometry=null,p.material=null,p.group=null}}return{opaque:t,transmissive:n,transparent:s,init:r,push:l,unshift:c,finish:u,sort:h}}function rS(){let i=new WeakMap;function e(n,s){let r=i.get(n),o;return r===void 0?(o=new Mm,i.set(n,[o])):s>=r.length?(o=new Mm,r.push(o)):o=r[s],o}function t(){i=new WeakMap}return{get:e,dispose:t}}function oS(){let i={};return{get:function(e){if(i[e.id]!==void 0)return i[e.id];let t;switch(e.type){case"SunLight":case"DirectionalLight":t={direction:new C,color:new De};break;case"SpotLight":t={position:new C,direction:new C,color:new De,distance:0,coneCos:0,penumbraCos:0,decay:0};break;case"PointLight":t={position:new C,color:new De,distance:0,decay:0};break;case"HemisphereLight":t={direction:new C,skyColor:new De,groundColor:new De};break;case"RectAreaLight":t={color:new De,position:new C,halfWidth:new C,halfHeight:new C};break}return i[e.id]=t,t}}}function aS(){let i={};return{get:function(e){if(i[e.id]!==void 0)return i[e.id];let t;switch(e.type){case"SunLight":case"DirectionalLight":t={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new _e};break;case"SpotLight":t={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new _e};break;case"PointLight":t={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new _e,shadowCameraNear:1,shadowCameraFar:1e3};break}return i[e.id]=t,t}}}var lS=0;function cS(i,e){return(e.castShadow?2:0)-(i.castShadow?2:0)+(e.map?1:0)-(i.map?1:0)}function hS(i){let e=new oS,t=aS(),n={version:0,hash:{sunLength:-1,directionalLength:-1,pointLength:-1,spotLength:-1,rectAreaLength:-1,hemiLength:-1,numSunShadows:-1,numDirectionalShadows:-1,numPointShadows:-1,numSpotShadows:-1,numSpotMaps:-1,numLightProbes:-1},ambient:[0,0,0],probe:[],sun:[],sunShadow:[],sunShadowMap:[],sunShadowMatrix:[],sunShadowCascade:[],directional:[],directionalShadow:[],directionalShadowMap:[],directionalShadowMatrix:[],spot:[],spotLightMap:[],spotShadow:[],spotShadowMap:[],spotLightMatrix:[],rectArea:[],rectAreaLTC1:null,rectAreaLTC2:null,point:[],pointShadow:[],pointShadowMap:[],pointShadowMatrix:[],hemi:[],numSpotLightShadowsWithMaps:0,numLightProbes:0};for(let c=0;c<9;c++)n.probe.push(new C);let s=new C,r=new Le,o=new Le;function a(c){let h=0,u=0,d=0;for(let L=0;L<9;L++)n.probe[L].set(0,0,0);let f=0,p=0,v=0,m=0,g=0,x=0,b=0,_=0,M=0,A=0,y=0,S=0,N=0,E=0;c.sort(cS);for(let L=0,O=c.length;L<O;L++){let I=c[L],k=I.color,H=I.intensity,W=I.distance,te=null;if(I.shadow&&I.shadow.map&&(I.shadow.map.texture.format===Xi?te=I.shadow.map.texture:te=I.shadow.map.depthTexture||I.shadow.map.texture),I.isAmbientLight)h+=k.r*H,u+=k.g*H,d+=k.b*H;else if(I.isLightProbe){for(let q=0;q<9;q++)n.probe[q].addScaledVector(I.sh.coefficients[q],H);E++}else if(I.isSunLight){let q=e.get(I);if(q.color.copy(I.color).multiplyScalar(I.intensity),I.castShadow){let Q=I.shadow,ee=t.get(I);ee.shadowIntensity=Q.intensity,ee.shadowBias=Q.bias,ee.shadowNormalBias=Q.normalBias,ee.shadowRadius=Q.radius,ee.shadowMapSize.copy(Q.mapSize).multiply(Q.getFrameExtents()),n.sunShadow[p]=ee,n.sunShadowMap[p]=te;let be=Q.getViewportCount();for(let Oe=0;Oe<be;Oe++)n.sunShadowMatrix[v+Oe]=Q.getMatrix(Oe),n.sunShadowCascade[v+Oe]=Q._cascadeData[Oe];v+=be,p++}n.sun[f]=q,f++}else if(I.isDirectionalLight){let q=e.get(I);if(q.color.copy(I.color).multiplyScalar(I.intensity),I.castShadow){let Q=I.shadow,ee=t.get(I);ee.shadowIntensity=Q.intensity,ee.shadowBias=Q.bias,ee.shadowNormalBias=Q.normalBias,ee.shadowRadius=Q.radius,ee.shadowMapSize=Q.mapSize,n.directionalShadow[m]=ee,n.directionalShadowMap[m]=te,n.directionalShadowMatrix[m]=I.shadow.matrix,M++}n.directional[m]=q,m++}else if(I.isSpotLight){let q=e.get(I);q.position.setFromMatrixPosition(I.matrixWorld),q.color.copy(k).multiplyScalar(H),q.distance=W,q.coneCos=Math.cos(I.angle),q.penumbraCos=Math.cos(I.angle*(1-I.penumbra)),q.decay=I.decay,n.spot[x]=q;let Q=I.shadow;if(I.map&&(n.spotLightMap[S]=I.map,S++,Q.updateMatrices(I),I.castShadow&&N++),n.spotLightMatrix[x]=Q.matrix,I.castShadow){let ee=t.get(I);ee.shadowIntensity=Q.intensity,ee.shadowBias=Q.bias,ee.shadowNormalBias=Q.normalBias,ee.shadowRadius=Q.radius,ee.shadowMapSize=Q.mapSize,n.spotShadow[x]=ee,n.spotShadowMap[x]=te,y++}x++}else if(I.isRectAreaLight){let q=e.get(I);q.color.copy(k).multiplyScalar(H),q.halfWidth.set(I.width*.5,0,0),q.halfHeight.set(0,I.height*.5,0),n.rectArea[b]=q,b++}else if(I.isPointLight){let q=e.get(I);if(q.color.copy(I.color).multiplyScalar(I.intensity),q.distance=I.distance,q.decay=I.decay,I.castShadow){let Q=I.shadow,ee=t.get(I);ee.shadowIntensity=Q.intensity,ee.shadowBias=Q.bias,ee.shadowNormalBias=Q.normalBias,ee.shadowRadius=Q.radius,ee.shadowMapSize=Q.mapSize,ee.shadowCameraNear=Q.camera.near,ee.shadowCameraFar=Q.camera.far,n.pointShadow[g]=ee,n.pointShadowMap[g]=te,n.pointShadowMatrix[g]=I.shadow.matrix,A++}n.point[g]=q,g++}else if(I.isHemisphereLight){let q=e.get(I);q.skyColor.copy(I.color).multiplyScalar(H),q.groundColor.copy(I.groundColor).multiplyScalar(H),n.hemi[_]=q,_++}}b>0&&(i.has("OES_texture_float_linear")===!0?(n.rectAreaLTC1=ge.LTC_FLOAT_1,n.rectAreaLTC2=ge.LTC_FLOAT_2):(n.rectAreaLTC1=ge.LTC_HALF_1,n.rectAreaLTC2=ge.LTC_HALF_2)),n.ambient[0]=h,n.ambient[1]=u,n.ambient[2]=d;let R=n.hash;(R.sunLength!==f||R.directionalLength!==m||R.pointLength!==g||R.spotLength!==x||R.rectAreaLength!==b||R.hemiLength!==_||R.numSunShadows!==p||R.numDirectionalShadows!==M||R.numPointShadows!==A||R.numSpotShadows!==y||R.numSpotMaps!==S||R.numLightProbes!==E)&&(n.sun.length=f,n.directional.length=m,n.spot.length=x,n.rectArea.length=b,n.point.length=g,n.hemi.length=_,n.sunShadow.length=p,n.sunShadowMap.length=p,n.sunShadowMatrix.length=v,n.sunShadowCascade.length=v,n.directionalShadow.length=M,n.directionalShadowMap.length=M,n.directionalShadowMatrix.length=M,n.pointShadow.length=A,n.pointShadowMap.length=A,n.pointShadowMatrix.length=A,n.spotShadow.length=y,n.spotShadowMap.length=y,n.spotLightMatrix.length=y+S-N,n.spotLightMap.length=S,n.numSpotLightShadowsWithMaps=N,n.numLightProbes=E,R.sunLength=f,R.directionalLength=m,R.pointLength=g,R.spotLength=x,R.rectAreaLength=b,R.hemiLength=_,R.numSunShadows=p,R.numDirectionalShadows=M,R.numPointShadows=A,R.numSpotShadows=y,R.numSpotMaps=S,R.numLightProbes=E,n.version=lS++)}function l(c,h){let u=0,d=0,f=0,p=0,v=0,m=0,g=h.matrixWorldInverse;for(let x=0,b=c.length;x<b;x++){let _=c[x];if(_.isSunLight){let M=n.sun[u];M.direction.setFromMatrixPosition(_.matrixWorld),M.direction.transformDirection(g),u++}else if(_.isDirectionalLight){let M=n.directional[d];M.direction.setFromMatrixPosition(_.matrixWorld),s.setFromMatrixPosition(_.target.matrixWorld),M.direction.sub(s),M.direction.transformDirection(g),d++}else if(_.isSpotLight){let M=n.spot[p];M.position.setFromMatrixPosition(_.matrixWorld),M.position.applyMatrix4(g),M.direction.setFromMatrixPosition(_.matrixWorld),s.setFromMatrixPosition(_.target.matrixWorld),M.direction.sub(s),M.direction.transformDirection(g),p++}else if(_.isRectAreaLight){let M=n.rectArea[v];M.position.setFromMatrixPosition(_.matrixWorld),M.position.applyMatrix4(g),o.identity(),r.copy(_.matrixWorld),r.premultiply(g),o.extractRotation(r),M.halfWidth.set(_.width*.5,0,0),M.halfHeight.set(0,_.height*.5,0),M.halfWidth.applyMatrix4(o),M.halfHeight.applyMatrix4(o),v++}else if(_.isPointLight){let M=n.point[f];M.position.setFromMatrixPosition(_.matrixWorld),M.position.applyMatrix4(g),f++}else if(_.isHemisphereLight){let M=n.hemi[m];M.direction.setFromMatrixPosition(_.matrixWorld),M.direction.transformDirection(g),m++}}}return{setup:a,setupView:l,state:n}}function Sm(i){let e=new hS(i),t=[],n=[],s=[];function r(u){h.camera=u,t.length=0,n.length=0,s.length=0}function o(u){u.isLightProbeGrid?s.push(u):t.push(u)}function a(u){n.push(u)}function l(){e.setup(t),s.sort((u,d)=>u.priority-d.priority||u.id-d.id)}function c(u){e.setupView(t,u)}let h={lightsArray:t,shadowsArray:n,lightProbeGridArray:s,camera:null,lights:e,transmissionRenderTarget:{},textureUnits:0};return{init:r,state:h,setupLights:l,setupLightsView:c,pushLight:o,pushShadow:a}}function uS(i){let e=new WeakMap;function t(s,r=0){let o=e.get(s),a;return o===void 0?(a=new Sm(i),e.set(s,[a])):r>=o.length?(a=new Sm(i),o.push(a)):a=o[r],a}function n(){e=new WeakMap}return{get:t,dispose:n}}var dS=`void main() {
	gl_Position = vec4( position, 1.0 );
}`,fS=`uniform sampler2D shadow_pass;
uniform vec2 resolution;
uniform float radius;
void main() {
	const float samples = float( VSM_SAMPLES );
	float mean = 0.0;
	float squared_mean = 0.0;
	float uvStride = samples <= 1.0 ? 0.0 : 2.0 / ( samples - 1.0 );
	float uvStart = samples <= 1.0 ? 0.0 : - 1.0;
	for ( float i = 0.0; i < samples; i ++ ) {
		float uvOffset = uvStart + i * uvStride;
		#ifdef HORIZONTAL_PASS
			vec2 distribution = texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( uvOffset, 0.0 ) * radius ) / resolution ).rg;
			mean += distribution.x;
			squared_mean += distribution.y * distribution.y + distribution.x * distribution.x;
		#else
			float depth = texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( 0.0, uvOffset ) * radius ) / resolution ).r;
			mean += depth;
			squared_mean += depth * depth;
		#endif
	}
	mean = mean / samples;
	squared_mean = squared_mean / samples;
	float std_dev = sqrt( max( 0.0, squared_mean - mean * mean ) );
	gl_FragColor = vec4( mean, std_dev, 0.0, 1.0 );
}`,pS=[new C(1,0,0),new C(-1,0,0),new C(0,1,0),new C(0,-1,0),new C(0,0,1),new C(0,0,-1)],mS=[new C(0,-1,0),new C(0,-1,0),new C(0,0,1),new C(0,0,-1),new C(0,-1,0),new C(0,-1,0)],wm=new Le,Ro=new C,td=new C;function gS(i,e,t){let n=new Vi,s=new _e,r=new _e,o=new Ct,a=new el,l=new tl,c={},h=t.maxTextureSize,u={[Nn]:Zt,[Zt]:Nn,[wt]:wt},d=new on({defines:{VSM_SAMPLES:8},uniforms:{shadow_pass:{value:null},resolution:{value:new _e},radius:{value:4}},vertexShader:dS,fragmentShader:fS}),f=d.clone();f.defines.HORIZONTAL_PASS=1;let p=new rt;p.setAttribute("position",new Qe(new Float32Array([-1,-1,.5,3,-1,.5,-1,3,.5]),3));let v=new Ke(p,d),m=this;this.enabled=!1,this.autoUpdate=!0,this.needsUpdate=!1,this.type=vo;let g=this.type;this.render=function(A,y,S){if(m.enabled===!1||m.autoUpdate===!1&&m.needsUpdate===!1||A.length===0)return;this.type===mp&&(Re("WebGLShadowMap: PCFSoftShadowMap has been removed. Using PCFShadowMap instead."),this.type=vo);let N=i.getRenderTarget(),E=i.getActiveCubeFace(),R=i.getActiveMipmapLevel(),L=i.state;L.setBlending(ds),L.buffers.depth.getReversed()===!0?L.buffers.color.setClear(0,0,0,0):L.buffers.color.setClear(1,1,1,1),L.buffers.depth.setTest(!0),L.setScissorTest(!1);let O=g!==this.type;O&&y.traverse(function(I){I.material&&(Array.isArray(I.material)?I.material.forEach(k=>k.needsUpdate=!0):I.material.needsUpdate=!0)});for(let I=0,k=A.length;I<k;I++){let H=A[I],W=H.shadow;if(W===void 0){Re("WebGLShadowMap:",H,"has no shadow.");continue}if(W.autoUpdate===!1&&W.needsUpdate===!1)continue;s.copy(W.mapSize);let te=W.getFrameExtents();s.multiply(te),r.copy(W.mapSize),(s.x>h||s.y>h)&&(s.x>h&&(r.x=Math.floor(h/te.x),s.x=r.x*te.x,W.mapSize.x=r.x),s.y>h&&(r.y=Math.floor(h/te.y),s.y=r.y*te.y,W.mapSize.y=r.y));let q=i.state.buffers.depth.getReversed();if(W.camera._reversedDepth=q,W.map===null||O===!0){if(W.map!==null&&(W.map.depthTexture!==null&&(W.map.depthTexture.dispose(),W.map.depthTexture=null),W.map.dispose()),this.type===ir){if(H.isPointLight){Re("WebGLShadowMap: VSM shadow maps are not supported for PointLights. Use PCF or BasicShadowMap instead.");continue}W.map=new gn(s.x,s.y,{format:Xi,type:Qn,minFilter:pn,magFilter:pn,generateMipmaps:!1}),W.map.texture.name=H.name+".shadowMap",W.map.depthTexture=new Ai(s.x,s.y,Cn),W.map.depthTexture.name=H.name+".shadowMapDepth",W.map.depthTexture.format=Ti,W.map.depthTexture.compareFunction=null,W.map.depthTexture.minFilter=Dt,W.map.depthTexture.magFilter=Dt}else H.isPointLight?(W.map=new Io(s.x),W.map.depthTexture=new lo(s.x,Wn)):(W.map=new gn(s.x,s.y),W.map.depthTexture=new Ai(s.x,s.y,Wn)),W.map.depthTexture.name=H.name+".shadowMap",W.map.depthTexture.format=Ti,this.type===vo?(W.map.depthTexture.compareFunction=q?Gu:Vu,W.map.depthTexture.minFilter=pn,W.map.depthTexture.magFilter=pn):(W.map.depthTexture.compareFunction=null,W.map.depthTexture.minFilter=Dt,W.map.depthTexture.magFilter=Dt);W.camera.updateProjectionMatrix()}W.map.isWebGLCubeRenderTarget!==!0&&(W.map.width!==s.x||W.map.height!==s.y)&&W.map.setSize(s.x,s.y);let Q=W.map.isWebGLCubeRenderTarget?6:W.getViewportCount();H.isPointLight!==!0&&W.updateMatrices(H,S);let ee=(W.camera.layers.mask&4294967294)!==0?W.camera.layers:S.layers;for(let be=0;be<Q;be++){let Oe=W.getCamera(be);if(H.isPointLight){let Z=W.camera,he=W.matrix,ve=H.distance||Z.far;ve!==Z.far&&(Z.far=ve,Z.updateProjectionMatrix()),Ro.setFromMatrixPosition(H.matrixWorld),Z.position.copy(Ro),td.copy(Z.position),td.add(pS[be]),Z.up.copy(mS[be]),Z.lookAt(td),Z.updateMatrixWorld(),he.makeTranslation(-Ro.x,-Ro.y,-Ro.z),wm.multiplyMatrices(Z.projectionMatrix,Z.matrixWorldInverse),W._frustum.setFromProjectionMatrix(wm,Z.coordinateSystem,Z.reversedDepth)}if(W.map.isWebGLCubeRenderTarget)i.setRenderTarget(W.map,be),i.clear();else{be===0&&(i.setRenderTarget(W.map),i.clear());let Z=W.getViewport(be);o.set(r.x*Z.x,r.y*Z.y,r.x*Z.z,r.y*Z.w),L.viewport(o)}n=W.getFrustum(be),_(y,S,Oe,H,ee,this.type)}W.isPointLightShadow!==!0&&this.type===ir&&x(W,S),W.needsUpdate=!1}g=this.type,m.needsUpdate=!1,i.setRenderTarget(N,E,R)};function x(A,y){let S=e.update(v);d.defines.VSM_SAMPLES!==A.blurSamples&&(d.defines.VSM_SAMPLES=A.blurSamples,f.defines.VSM_SAMPLES=A.blurSamples,d.needsUpdate=!0,f.needsUpdate=!0),A.mapPass===null?A.mapPass=new gn(s.x,s.y,{format:Xi,type:Qn}):(A.mapPass.width!==A.map.width||A.mapPass.height!==A.map.height)&&A.mapPass.setSize(A.map.width,A.map.height),d.uniforms.shadow_pass.value=A.map.depthTexture,d.uniforms.resolution.value.set(A.map.width,A.map.height),d.uniforms.radius.value=A.radius,i.setRenderTarget(A.mapPass),i.clear(),i.renderBufferDirect(y,null,S,d,v,null),f.uniforms.shadow_pass.value=A.mapPass.texture,f.uniforms.resolution.value.set(A.map.width,A.map.height),f.uniforms.radius.value=A.radius,i.setRenderTarget(A.map),i.clear(),i.renderBufferDirect(y,null,S,f,v,null)}function b(A,y,S,N){let E=null,R=S.isPointLight===!0?A.customDistanceMaterial:A.customDepthMaterial;if(R!==void 0)E=R;else if(E=S.isPointLight===!0?l:a,i.localClippingEnabled&&y.clipShadows===!0&&Array.isArray(y.clippingPlanes)&&y.clippingPlanes.length!==0||y.displacementMap&&y.displacementScale!==0||y.alphaMap&&y.alphaTest>0||y.map&&y.alphaTest>0||y.alphaToCoverage===!0){let L=E.uuid,O=y.uuid,I=c[L];I===void 0&&(I={},c[L]=I);let k=I[O];k===void 0&&(k=E.clone(),I[O]=k,y.addEventListener("dispose",M)),E=k}if(E.visible=y.visible,E.wireframe=y.wireframe,N===ir?E.side=y.shadowSide!==null?y.shadowSide:y.side:E.side=y.shadowSide!==null?y.shadowSide:u[y.side],E.alphaMap=y.alphaMap,E.alphaTest=y.alphaToCoverage===!0?.5:y.alphaTest,E.map=y.map,E.clipShadows=y.clipShadows,E.clippingPlanes=y.clippingPlanes,E.clipIntersection=y.clipIntersection,E.displacementMap=y.displacementMap,E.displacementScale=y.displacementScale,E.displacementBias=y.displacementBias,E.wireframeLinewidth=y.wireframeLinewidth,E.linewidth=y.linewidth,S.isPointLight===!0&&E.isMeshDistanceMaterial===!0){let L=i.properties.get(E);L.light=S}return E}function _(A,y,S,N,E,R){if(A.visible===!1)return;if(A.layers.test(E)&&(A.isMesh||A.isLine||A.isPoints)&&(A.castShadow||A.receiveShadow&&R===ir)&&(!A.frustumCulled||A.intersectsFrustum(n))){A.modelViewMatrix.multiplyMatrices(S.matrixWorldInverse,A.matrixWorld);let I=e.update(A),k=A.material;if(Array.isArray(k)){let H=I.groups;for(let W=0,te=H.length;W<te;W++){let q=H[W],Q=k[q.materialIndex];if(Q&&Q.visible){let ee=b(A,Q,N,R);A.onBeforeShadow(i,A,y,S,I,ee,q),i.renderBufferDirect(S,null,I,ee,A,q),A.onAfterShadow(i,A,y,S,I,ee,q)}}}else if(k.visible){let H=b(A,k,N,R);A.onBeforeShadow(i,A,y,S,I,H,null),i.renderBufferDirect(S,null,I,H,A,null),A.onAfterShadow(i,A,y,S,I,H,null)}}let O=A.children;for(let I=0,k=O.length;I<k;I++)_(O[I],y,S,N,E,R)}function M(A){A.target.removeEventListener("dispose",M);for(let S in c){let N=c[S],E=A.target.uuid;E in N&&(N[E].dispose(),delete N[E])}}}function yS(i,e){function t(){let D=!1,J=new Ct,$=null,le=new Ct(0,0,0,0);return{setMask:function(se){$!==se&&!D&&(i.colorMask(se,se,se,se),$=se)},setLocked:function(se){D=se},setClear:function(se,oe,Ae,He,ie){ie===!0&&(se*=He,oe*=He,Ae*=He),J.set(se,oe,Ae,He),le.equals(J)===!1&&(i.clearColor(se,oe,Ae,He),le.copy(J))},reset:function(){D=!1,$=null,le.set(-1,0,0,0)}}}function n(){let D=!1,J=!1,$=null,le=null,se=null;return{setReversed:function(oe){if(J!==oe){let Ae=e.get("EXT_clip_control");oe?Ae.clipControlEXT(Ae.LOWER_LEFT_EXT,Ae.ZERO_TO_ONE_EXT):Ae.clipControlEXT(Ae.LOWER_LEFT_EXT,Ae.NEGATIVE_ONE_TO_ONE_EXT),J=oe;let He=se;se=null,this.setClear(He)}},getReversed:function(){return J},setTest:function(oe){oe?pe(i.DEPTH_TEST):Fe(i.DEPTH_TEST)},setMask:function(oe){$!==oe&&!D&&(i.depthMask(oe),$=oe)},setFunc:function(oe){if(J&&(oe=Yp[oe]),le!==oe){switch(oe){case Ua:i.depthFunc(i.NEVER);break;case Fa:i.depthFunc(i.ALWAYS);break;case Ba:i.depthFunc(i.LESS);break;case Gs:i.depthFunc(i.LEQUAL);break;case ka:i.depthFunc(i.EQUAL);break;case za:i.depthFunc(i.GEQUAL);break;case Va:i.depthFunc(i.GREATER);break;case Ga:i.depthFunc(i.NOTEQUAL);break;default:i.depthFunc(i.LEQUAL)}le=oe}},setLocked:function(oe){D=oe},setClear:function(oe){se!==oe&&(se=oe,J&&(oe=1-oe),i.clearDepth(oe))},reset:function(){D=!1,$=null,le=null,se=null,J=!1}}}function s(){let D=!1,J=null,$=null,le=null,se=null,oe=null,Ae=null,He=null,ie=null;return{setTest:function(Ee){D||(Ee?pe(i.STENCIL_TEST):Fe(i.STENCIL_TEST))},setMask:function(Ee){J!==Ee&&!D&&(i.stencilMask(Ee),J=Ee)},setFunc:function(Ee,Ge,me){($!==Ee||le!==Ge||se!==me)&&(i.stencilFunc(Ee,Ge,me),$=Ee,le=Ge,se=me)},setOp:function(Ee,Ge,me){(oe!==Ee||Ae!==Ge||He!==me)&&(i.stencilOp(Ee,Ge,me),oe=Ee,Ae=Ge,He=me)},setLocked:function(Ee){D=Ee},setClear:function(Ee){ie!==Ee&&(i.clearStencil(Ee),ie=Ee)},reset:function(){D=!1,J=null,$=null,le=null,se=null,oe=null,Ae=null,He=null,ie=null}}}let r=new t,o=new n,a=new s,l={},c=new WeakMap,h={},u={},d={},f=new WeakMap,p=[],v=null,m=!1,g=null,x=null,b=null,_=null,M=null,A=null,y=null,S=new De(0,0,0),N=0,E=!1,R=null,L=null,O=null,I=null,k=null,H=i.getParameter(i.MAX_COMBINED_TEXTURE_IMAGE_UNITS),W=!1,te=0,q=i.getParameter(i.VERSION);q.indexOf("WebGL")!==-1?(te=parseFloat(/^WebGL (\d)/.exec(q)[1]),W=te>=1):q.indexOf("OpenGL ES")!==-1&&(te=parseFloat(/^OpenGL ES (\d)/.exec(q)[1]),W=te>=2);let Q=null,ee={},be=i.getParameter(i.SCISSOR_BOX),Oe=i.getParameter(i.VIEWPORT),Z=new Ct().fromArray(be),he=new Ct().fromArray(Oe);function ve(D,J,$,le){let se=new Uint8Array(4),oe=i.createTexture();i.bindTexture(D,oe),i.texParameteri(D,i.TEXTURE_MIN_FILTER,i.NEAREST),i.texParameteri(D,i.TEXTURE_MAG_FILTER,i.NEAREST);for(let Ae=0;Ae<$;Ae++)D===i.TEXTURE_3D||D===i.TEXTURE_2D_ARRAY?i.texImage3D(J,0,i.RGBA,1,1,le,0,i.RGBA,i.UNSIGNED_BYTE,se):i.texImage2D(J+Ae,0,i.RGBA,1,1,0,i.RGBA,i.UNSIGNED_BYTE,se);return oe}let Ce={};Ce[i.TEXTURE_2D]=ve(i.TEXTURE_2D,i.TEXTURE_2D,1),Ce[i.TEXTURE_CUBE_MAP]=ve(i.TEXTURE_CUBE_MAP,i.TEXTURE_CUBE_MAP_POSITIVE_X,6),Ce[i.TEXTURE_2D_ARRAY]=ve(i.TEXTURE_2D_ARRAY,i.TEXTURE_2D_ARRAY,1,1),Ce[i.TEXTURE_3D]=ve(i.TEXTURE_3D,i.TEXTURE_3D,1,1),r.setClear(0,0,0,1),o.setClear(1),a.setClear(0),pe(i.DEPTH_TEST),o.setFunc(Gs),Mn(!1),Tt(xu),pe(i.CULL_FACE),qt(ds);function pe(D){h[D]!==!0&&(i.enable(D),h[D]=!0)}function Fe(D){h[D]!==!1&&(i.disable(D),h[D]=!1)}function Rt(D,J){return d[D]!==J?(i.bindFramebuffer(D,J),d[D]=J,D===i.DRAW_FRAMEBUFFER&&(d[i.FRAMEBUFFER]=J),D===i.FRAMEBUFFER&&(d[i.DRAW_FRAMEBUFFER]=J),!0):!1}function Pe(D,J){let $=p,le=!1;if(D){$=f.get(J),$===void 0&&($=[],f.set(J,$));let se=D.textures;if($.length!==se.length||$[0]!==i.COLOR_ATTACHMENT0){for(let oe=0,Ae=se.length;oe<Ae;oe++)$[oe]=i.COLOR_ATTACHMENT0+oe;$.length=se.length,le=!0}}else $[0]!==i.BACK&&($[0]=i.BACK,le=!0);le&&i.drawBuffers($)}function nt(D){return v!==D?(i.useProgram(D),v=D,!0):!1}let pt={[fs]:i.FUNC_ADD,[yp]:i.FUNC_SUBTRACT,[xp]:i.FUNC_REVERSE_SUBTRACT};pt[_p]=i.MIN,pt[vp]=i.MAX;let je={[bp]:i.ZERO,[Mp]:i.ONE,[Sp]:i.SRC_COLOR,[Mu]:i.SRC_ALPHA,[Rp]:i.SRC_ALPHA_SATURATE,[Ep]:i.DST_COLOR,[Tp]:i.DST_ALPHA,[wp]:i.ONE_MINUS_SRC_COLOR,[Su]:i.ONE_MINUS_SRC_ALPHA,[Cp]:i.ONE_MINUS_DST_COLOR,[Ap]:i.ONE_MINUS_DST_ALPHA,[Pp]:i.CONSTANT_COLOR,[Ip]:i.ONE_MINUS_CONSTANT_COLOR,[Lp]:i.CONSTANT_ALPHA,[Np]:i.ONE_MINUS_CONSTANT_ALPHA};function qt(D,J,$,le,se,oe,Ae,He,ie,Ee){if(D===ds){m===!0&&(Fe(i.BLEND),m=!1);return}if(m===!1&&(pe(i.BLEND),m=!0),D!==gp){if(D!==g||Ee!==E){if((x!==fs||M!==fs)&&(i.blendEquation(i.FUNC_ADD),x=fs,M=fs),Ee)switch(D){case sr:i.blendFuncSeparate(i.ONE,i.ONE_MINUS_SRC_ALPHA,i.ONE,i.ONE_MINUS_SRC_ALPHA);break;case _u:i.blendFunc(i.ONE,i.ONE);break;case vu:i.blendFuncSeparate(i.ZERO,i.ONE_MINUS_SRC_COLOR,i.ZERO,i.ONE);break;case bu:i.blendFuncSeparate(i.DST_COLOR,i.ONE_MINUS_SRC_ALPHA,i.ZERO,i.ONE);break;default:Ne("WebGLState: Invalid blending: ",D);break}else switch(D){case sr:i.blendFuncSeparate(i.SRC_ALPHA,i.ONE_MINUS_SRC_ALPHA,i.ONE,i.ONE_MINUS_SRC_ALPHA);break;case _u:i.blendFuncSeparate(i.SRC_ALPHA,i.ONE,i.ONE,i.ONE);break;case vu:Ne("WebGLState: SubtractiveBlending requires material.premultipliedAlpha = true");break;case bu:Ne("WebGLState: MultiplyBlending requires material.premultipliedAlpha = true");break;default:Ne("WebGLState: Invalid blending: ",D);break}b=null,_=null,A=null,y=null,S.set(0,0,0),N=0,g=D,E=Ee}return}se=se||J,oe=oe||$,Ae=Ae||le,(J!==x||se!==M)&&(i.blendEquationSeparate(pt[J],pt[se]),x=J,M=se),($!==b||le!==_||oe!==A||Ae!==y)&&(i.blendFuncSeparate(je[$],je[le],je[oe],je[Ae]),b=$,_=le,A=oe,y=Ae),(He.equals(S)===!1||ie!==N)&&(i.blendColor(He.r,He.g,He.b,ie),S.copy(He),N=ie),g=D,E=!1}function Ot(D,J){D.side===wt?Fe(i.CULL_FACE):pe(i.CULL_FACE);let $=D.side===Zt;J&&($=!$),Mn($),D.blending===sr&&D.transparent===!1?qt(ds):qt(D.blending,D.blendEquation,D.blendSrc,D.blendDst,D.blendEquationAlpha,D.blendSrcAlpha,D.blendDstAlpha,D.blendColor,D.blendAlpha,D.premultipliedAlpha),o.setFunc(D.depthFunc),o.setTest(D.depthTest),o.setMask(D.depthWrite),r.setMask(D.colorWrite);let le=D.stencilWrite;a.setTest(le),le&&(a.setMask(D.stencilWriteMask),a.setFunc(D.stencilFunc,D.stencilRef,D.stencilFuncMask),a.setOp(D.stencilFail,D.stencilZFail,D.stencilZPass)),zt(D.polygonOffset,D.polygonOffsetFactor,D.polygonOffsetUnits),D.alphaToCoverage===!0?pe(i.SAMPLE_ALPHA_TO_COVERAGE):Fe(i.SAMPLE_ALPHA_TO_COVERAGE)}function Mn(D){R!==D&&(D?i.frontFace(i.CW):i.frontFace(i.CCW),R=D)}function Tt(D){D!==fp?(pe(i.CULL_FACE),D!==L&&(D===xu?i.cullFace(i.BACK):D===pp?i.cullFace(i.FRONT):i.cullFace(i.FRONT_AND_BACK))):Fe(i.CULL_FACE),L=D}function si(D){D!==O&&(W&&i.lineWidth(D),O=D)}function zt(D,J,$){D?(pe(i.POLYGON_OFFSET_FILL),(I!==J||k!==$)&&(I=J,k=$,o.getReversed()&&(J=-J,$=-$),i.polygonOffset(J,$))):Fe(i.POLYGON_OFFSET_FILL)}function Fn(D){D?pe(i.SCISSOR_TEST):Fe(i.SCISSOR_TEST)}function Bn(D){D===void 0&&(D=i.TEXTURE0+H-1),Q!==D&&(i.activeTexture(D),Q=D)}function kn(D,J,$){$===void 0&&(Q===null?$=i.TEXTURE0+H-1:$=Q);let le=ee[$];le===void 0&&(le={type:void 0,texture:void 0},ee[$]=le),(le.type!==D||le.texture!==J)&&(Q!==$&&(i.activeTexture($),Q=$),i.bindTexture(D,J||Ce[D]),le.type=D,le.texture=J)}function B(){let D=ee[Q];D!==void 0&&D.type!==void 0&&(i.bindTexture(D.type,null),D.type=void 0,D.texture=void 0)}function zn(){try{i.compressedTexImage2D(...arguments)}catch(D){Ne("WebGLState:",D)}}function bt(){try{i.compressedTexImage3D(...arguments)}catch(D){Ne("WebGLState:",D)}}function Mt(){try{i.texSubImage2D(...arguments)}catch(D){Ne("WebGLState:",D)}}function fe(){try{i.texSubImage3D(...arguments)}catch(D){Ne("WebGLState:",D)}}function Ut(){try{i.compressedTexSubImage2D(...arguments)}catch(D){Ne("WebGLState:",D)}}function Ie(){try{i.compressedTexSubImage3D(...arguments)}catch(D){Ne("WebGLState:",D)}}function Be(){try{i.texStorage2D(...arguments)}catch(D){Ne("WebGLState:",D)}}function P(){try{i.texStorage3D(...arguments)}catch(D){Ne("WebGLState:",D)}}function w(){try{i.texImage2D(...arguments)}catch(D){Ne("WebGLState:",D)}}function V(){try{i.texImage3D(...arguments)}catch(D){Ne("WebGLState:",D)}}function ne(D){return u[D]!==void 0?u[D]:i.getParameter(D)}function K(D,J){u[D]!==J&&(i.pixelStorei(D,J),u[D]=J)}function re(D){Z.equals(D)===!1&&(i.scissor(D.x,D.y,D.z,D.w),Z.copy(D))}function ue(D){he.equals(D)===!1&&(i.viewport(D.x,D.y,D.z,D.w),he.copy(D))}function Y(D,J){let $=c.get(J);$===void 0&&($=new WeakMap,c.set(J,$));let le=$.get(D);le===void 0&&(le=i.getUniformBlockIndex(J,D.name),i.uniformBlockBinding(J,le,le),$.set(D,le))}function j(D,J,$){let se=c.get(J).get(D);l[se]!==$&&(i.bindBufferBase(i.UNIFORM_BUFFER,se,$),l[se]=$)}function ae(){i.disable(i.BLEND),i.disable(i.CULL_FACE),i.disable(i.DEPTH_TEST),i.disable(i.POLYGON_OFFSET_FILL),i.disable(i.SCISSOR_TEST),i.disable(i.STENCIL_TEST),i.disable(i.SAMPLE_ALPHA_TO_COVERAGE),i.blendEquation(i.FUNC_ADD),i.blendFunc(i.ONE,i.ZERO),i.blendFuncSeparate(i.ONE,i.ZERO,i.ONE,i.ZERO),i.blendColor(0,0,0,0),i.colorMask(!0,!0,!0,!0),i.clearColor(0,0,0,0),i.depthMask(!0),i.depthFunc(i.LESS),o.setReversed(!1),i.clearDepth(1),i.stencilMask(4294967295),i.stencilFunc(i.ALWAYS,0,4294967295),i.stencilOp(i.KEEP,i.KEEP,i.KEEP),i.clearStencil(0),i.cullFace(i.BACK),i.frontFace(i.CCW),i.polygonOffset(0,0),i.activeTexture(i.TEXTURE0),i.bindFramebuffer(i.FRAMEBUFFER,null),i.bindFramebuffer(i.DRAW_FRAMEBUFFER,null),i.bindFramebuffer(i.READ_FRAMEBUFFER,null),i.useProgram(null),i.lineWidth(1),i.scissor(0,0,i.canvas.width,i.canvas.height),i.viewport(0,0,i.canvas.width,i.canvas.height),i.pixelStorei(i.PACK_ALIGNMENT,4),i.pixelStorei(i.UNPACK_ALIGNMENT,4),i.pixelStorei(i.UNPACK_FLIP_Y_WEBGL,!1),i.pixelStorei(i.UNPACK_PREMULTIPLY_ALPHA_WEBGL,!1),i.pixelStorei(i.UNPACK_COLORSPACE_CONVERSION_WEBGL,i.BROWSER_DEFAULT_WEBGL),i.pixelStorei(i.PACK_ROW_LENGTH,0),i.pixelStorei(i.PACK_SKIP_PIXELS,0),i.pixelStorei(i.PACK_SKIP_ROWS,0),i.pixelStorei(i.UNPACK_ROW_LENGTH,0),i.pixelStorei(i.UNPACK_IMAGE_HEIGHT,0),i.pixelStorei(i.UNPACK_SKIP_PIXELS,0),i.pixelStorei(i.UNPACK_SKIP_ROWS,0),i.pixelStorei(i.UNPACK_SKIP_IMAGES,0),h={},u={},Q=null,ee={},d={},l={},f=new WeakMap,p=[],v=null,m=!1,g=null,x=null,b=null,_=null,M=null,A=null,y=null,S=new De(0,0,0),N=0,E=!1,R=null,L=null,O=null,I=null,k=null,Z.set(0,0,i.canvas.width,i.canvas.height),he.set(0,0,i.canvas.width,i.canvas.height),r.reset(),o.reset(),a.reset()}return{buffers:{color:r,depth:o,stencil:a},enable:pe,disable:Fe,bindFramebuffer:Rt,drawBuffers:Pe,useProgram:nt,setBlending:qt,setMaterial:Ot,setFlipSided:Mn,setCullFace:Tt,setLineWidth:si,setPolygonOffset:zt,setScissorTest:Fn,activeTexture:Bn,bindTexture:kn,unbindTexture:B,compressedTexImage2D:zn,compressedTexImage3D:bt,texImage2D:w,texImage3D:V,pixelStorei:K,getParameter:ne,updateUBOMapping:Y,uniformBlockBinding:j,texStorage2D:Be,texStorage3D:P,texSubImage2D:Mt,texSubImage3D:fe,compressedTexSubImage2D:Ut,compressedTexSubImage3D:Ie,scissor:re,viewport:ue,reset:ae}}function xS(i,e,t,n,s,r,o){let a=e.has("WEBGL_multisampled_render_to_texture")?e.get("WEBGL_multisampled_render_to_texture"):null,l=typeof navigator>"u"?!1:/OculusBrowser/g.test(navigator.userAgent),c=new _e,h=new WeakMap,u=new Set,d,f=new WeakMap,p=new Set,v=new FinalizationRegistry(P=>p.delete(P)),m=!1;try{m=typeof OffscreenCanvas<"u"&&new OffscreenCanvas(1,1).getContext("2d")!==null}catch{}function g(P,w){return m?new OffscreenCanvas(P,w):Kr("canvas")}function x(P,w,V){let ne=1,K=Be(P);if((K.width>V||K.height>V)&&(ne=V/Math.max(K.width,K.height)),ne<1)if(typeof HTMLImageElement<"u"&&P instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&P instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&P instanceof ImageBitmap||typeof VideoFrame<"u"&&P instanceof VideoFrame){let re=Math.floor(ne*K.width),ue=Math.floor(ne*K.height);d===void 0&&(d=g(re,ue));let Y=w?g(re,ue):d;return Y.width=re,Y.height=ue,Y.getContext("2d").drawImage(P,0,0,re,ue),Re("WebGLRenderer: Texture has been resized from ("+K.width+"x"+K.height+") to ("+re+"x"+ue+")."),Y}else return"data"in P&&Re("WebGLRenderer: Image in DataTexture is too big ("+K.width+"x"+K.height+")."),P;return P}function b(P){return P.generateMipmaps}function _(P){i.generateMipmap(P)}function M(P){return P.isWebGLCubeRenderTarget?i.TEXTURE_CUBE_MAP:P.isWebGL3DRenderTarget?i.TEXTURE_3D:P.isWebGLArrayRenderTarget||P.isCompressedArrayTexture?i.TEXTURE_2D_ARRAY:i.TEXTURE_2D}function A(P,w,V,ne,K,re=!1){if(P!==null){if(i[P]!==void 0)return i[P];Re("WebGLRenderer: Attempt to use non-existing WebGL internal format '"+P+"'")}let ue;ne&&(ue=e.get("EXT_texture_norm16"),ue||Re("WebGLRenderer: Unable to use normalized textures without EXT_texture_norm16 extension"));let Y=w;if(w===i.RED&&(V===i.FLOAT&&(Y=i.R32F),V===i.HALF_FLOAT&&(Y=i.R16F),V===i.UNSIGNED_BYTE&&(Y=i.R8),V===i.UNSIGNED_SHORT&&ue&&(Y=ue.R16_EXT),V===i.SHORT&&ue&&(Y=ue.R16_SNORM_EXT)),w===i.RED_INTEGER&&(V===i.UNSIGNED_BYTE&&(Y=i.R8UI),V===i.UNSIGNED_SHORT&&(Y=i.R16UI),V===i.UNSIGNED_INT&&(Y=i.R32UI),V===i.BYTE&&(Y=i.R8I),V===i.SHORT&&(Y=i.R16I),V===i.INT&&(Y=i.R32I)),w===i.RG&&(V===i.FLOAT&&(Y=i.RG32F),V===i.HALF_FLOAT&&(Y=i.RG16F),V===i.UNSIGNED_BYTE&&(Y=i.RG8),V===i.UNSIGNED_SHORT&&ue&&(Y=ue.RG16_EXT),V===i.SHORT&&ue&&(Y=ue.RG16_SNORM_EXT)),w===i.RG_INTEGER&&(V===i.UNSIGNED_BYTE&&(Y=i.RG8UI),V===i.UNSIGNED_SHORT&&(Y=i.RG16UI),V===i.UNSIGNED_INT&&(Y=i.RG32UI),V===i.BYTE&&(Y=i.RG8I),V===i.SHORT&&(Y=i.RG16I),V===i.INT&&(Y=i.RG32I)),w===i.RGB_INTEGER&&(V===i.UNSIGNED_BYTE&&(Y=i.RGB8UI),V===i.UNSIGNED_SHORT&&(Y=i.RGB16UI),V===i.UNSIGNED_INT&&(Y=i.RGB32UI),V===i.BYTE&&(Y=i.RGB8I),V===i.SHORT&&(Y=i.RGB16I),V===i.INT&&(Y=i.RGB32I)),w===i.RGBA_INTEGER&&(V===i.UNSIGNED_BYTE&&(Y=i.RGBA8UI),V===i.UNSIGNED_SHORT&&(Y=i.RGBA16UI),V===i.UNSIGNED_INT&&(Y=i.RGBA32UI),V===i.BYTE&&(Y=i.RGBA8I),V===i.SHORT&&(Y=i.RGBA16I),V===i.INT&&(Y=i.RGBA32I)),w===i.RGB&&(V===i.UNSIGNED_SHORT&&ue&&(Y=ue.RGB16_EXT),V===i.SHORT&&ue&&(Y=ue.RGB16_SNORM_EXT),V===i.UNSIGNED_INT_5_9_9_9_REV&&(Y=i.RGB9_E5),V===i.UNSIGNED_INT_10F_11F_11F_REV&&(Y=i.R11F_G11F_B10F)),w===i.RGBA){let j=re?Zr:$e.getTransfer(K);V===i.FLOAT&&(Y=i.RGBA32F),V===i.HALF_FLOAT&&(Y=i.RGBA16F),V===i.UNSIGNED_BYTE&&(Y=j===ht?i.SRGB8_ALPHA8:i.RGBA8),V===i.UNSIGNED_SHORT&&ue&&(Y=ue.RGBA16_EXT),V===i.SHORT&&ue&&(Y=ue.RGBA16_SNORM_EXT),V===i.UNSIGNED_SHORT_4_4_4_4&&(Y=i.RGBA4),V===i.UNSIGNED_SHORT_5_5_5_1&&(Y=i.RGB5_A1)}return(Y===i.R16F||Y===i.R32F||Y===i.RG16F||Y===i.RG32F||Y===i.RGBA16F||Y===i.RGBA32F)&&e.get("EXT_color_buffer_float"),Y}function y(P,w){let V;return P?w===null||w===Wn||w===ms?V=i.DEPTH24_STENCIL8:w===Cn?V=i.DEPTH32F_STENCIL8:w===or&&(V=i.DEPTH24_STENCIL8,Re("DepthTexture: 16 bit depth attachment is not supported with stencil. Using 24-bit attachment.")):w===null||w===Wn||w===ms?V=i.DEPTH_COMPONENT24:w===Cn?V=i.DEPTH_COMPONENT32F:w===or&&(V=i.DEPTH_COMPONENT16),V}function S(P,w){return b(P)===!0||P.isFramebufferTexture&&P.minFilter!==Dt&&P.minFilter!==pn?Math.log2(Math.max(w.width,w.height))+1:P.mipmaps.length>0?P.mipmaps.length:P.isCompressedTexture&&Array.isArray(P.image)?w.mipmaps.length:1}function N(P){let w=new WeakRef(P);n.get(P).__ref=w,p.add(w),v.register(P,w,w)}function E(P){let w=n.get(P).__ref;w!==void 0&&(p.delete(w),v.unregister(w))}function R(P){O(P.target)}function L(P){I(P.target)}function O(P){P.removeEventListener("dispose",R),E(P),H(P),P.isVideoTexture&&h.delete(P),P.isHTMLTexture&&u.delete(P)}function I(P){P.removeEventListener("dispose",L),E(P),te(P)}function k(){for(let P of p){let w=P.deref();w!==void 0&&(w.isRenderTarget===!0?I(w):O(w))}p.clear(),u.clear()}function H(P){let w=n.get(P);if(w.__webglInit===void 0)return;let V=P.source,ne=f.get(V);if(ne){let K=ne[w.__cacheKey];K.usedTimes--,K.usedTimes===0&&W(P),Object.keys(ne).length===0&&f.delete(V)}n.remove(P)}function W(P){let w=n.get(P);i.deleteTexture(w.__webglTexture);let V=P.source,ne=f.get(V);delete ne[w.__cacheKey],o.memory.textures--}function te(P){let w=n.get(P);w.__depthDisposeCallback&&w.__depthDisposeCallback();let V=P.depthTexture;if(V&&V.renderTarget===P&&O(V),P.isWebGLCubeRenderTarget)for(let K=0;K<6;K++){if(Array.isArray(w.__webglFramebuffer[K]))for(let re=0;re<w.__webglFramebuffer[K].length;re++)i.deleteFramebuffer(w.__webglFramebuffer[K][re]);else i.deleteFramebuffer(w.__webglFramebuffer[K]);w.__webglDepthbuffer&&i.deleteRenderbuffer(w.__webglDepthbuffer[K])}else{if(Array.isArray(w.__webglFramebuffer))for(let K=0;K<w.__webglFramebuffer.length;K++)i.deleteFramebuffer(w.__webglFramebuffer[K]);else i.deleteFramebuffer(w.__webglFramebuffer);if(w.__webglDepthbuffer&&i.deleteRenderbuffer(w.__webglDepthbuffer),w.__webglMultisampledFramebuffer&&i.deleteFramebuffer(w.__webglMultisampledFramebuffer),w.__webglColorRenderbuffer)for(let K=0;K<w.__webglColorRenderbuffer.length;K++)w.__webglColorRenderbuffer[K]&&i.deleteRenderbuffer(w.__webglColorRenderbuffer[K]);w.__webglDepthRenderbuffer&&i.deleteRenderbuffer(w.__webglDepthRenderbuffer)}let ne=P.textures;for(let K=0,re=ne.length;K<re;K++){let ue=n.get(ne[K]);ue.__webglTexture&&(i.deleteTexture(ue.__webglTexture),o.memory.textures--),n.remove(ne[K])}n.remove(P)}let q=0;function Q(){q=0}function ee(){return q}function be(P){q=P}function Oe(){let P=q;return P>=s.maxTextures&&Re("WebGLTextures: Trying to use "+(P+1)+" texture units while this GPU supports only "+s.maxTextures),q+=1,P}function Z(P){let w=[];return w.push(P.wrapS),w.push(P.wrapT),w.push(P.wrapR||0),w.push(P.magFilter),w.push(P.minFilter),w.push(P.anisotropy),w.push(P.internalFormat),w.push(P.format),w.push(P.type),w.push(P.generateMipmaps),w.push(P.mipmapsAutoUpdate),w.push(P.premultiplyAlpha),w.push(P.flipY),w.push(P.unpackAlignment),w.push(P.colorSpace),w.join()}function he(P,w){let V=n.get(P);if(P.isVideoTexture&&Ut(P),P.isRenderTargetTexture===!1&&P.isExternalTexture!==!0&&P.version>0&&V.__version!==P.version){let ne=P.image;if(ne===null)Re("WebGLRenderer: Texture marked for update but no image data found.");else if(ne.complete===!1)Re("WebGLRenderer: Texture marked for update but image is incomplete");else{Ot(V,P,w);return}}else P.isExternalTexture&&(V.__webglTexture=P.sourceTexture?P.sourceTexture:null);t.bindTexture(i.TEXTURE_2D,V.__webglTexture,i.TEXTURE0+w)}function ve(P,w){let V=n.get(P);if(P.isRenderTargetTexture===!1&&P.version>0&&V.__version!==P.version){Ot(V,P,w);return}else P.isExternalTexture&&(V.__webglTexture=P.sourceTexture?P.sourceTexture:null);t.bindTexture(i.TEXTURE_2D_ARRAY,V.__webglTexture,i.TEXTURE0+w)}function Ce(P,w){let V=n.get(P);if(P.isRenderTargetTexture===!1&&P.version>0&&V.__version!==P.version){Ot(V,P,w);return}t.bindTexture(i.TEXTURE_3D,V.__webglTexture,i.TEXTURE0+w)}function pe(P,w){let V=n.get(P);if(P.version>0&&V.__version!==P.version){Mn(V,P,w);return}t.bindTexture(i.TEXTURE_CUBE_MAP,V.__webglTexture,i.TEXTURE0+w)}let Fe={[Ha]:i.REPEAT,[ai]:i.CLAMP_TO_EDGE,[Wa]:i.MIRRORED_REPEAT},Rt={[Dt]:i.NEAREST,[Up]:i.NEAREST_MIPMAP_NEAREST,[bo]:i.NEAREST_MIPMAP_LINEAR,[pn]:i.LINEAR,[ml]:i.LINEAR_MIPMAP_NEAREST,[Ei]:i.LINEAR_MIPMAP_LINEAR},Pe={[zp]:i.NEVER,[Hu]:i.ALWAYS,[Vp]:i.LESS,[Vu]:i.LEQUAL,[Gp]:i.EQUAL,[Gu]:i.GEQUAL,[Hp]:i.GREATER,[Wp]:i.NOTEQUAL};function nt(P,w){if(w.type===Cn&&e.has("OES_texture_float_linear")===!1&&(w.magFilter===pn||w.magFilter===ml||w.magFilter===bo||w.magFilter===Ei||w.minFilter===pn||w.minFilter===ml||w.minFilter===bo||w.minFilter===Ei)&&Re("WebGLRenderer: Unable to use linear filtering with floating point textures. OES_texture_float_linear not supported on this device."),i.texParameteri(P,i.TEXTURE_WRAP_S,Fe[w.wrapS]),i.texParameteri(P,i.TEXTURE_WRAP_T,Fe[w.wrapT]),(P===i.TEXTURE_3D||P===i.TEXTURE_2D_ARRAY)&&i.texParameteri(P,i.TEXTURE_WRAP_R,Fe[w.wrapR]),i.texParameteri(P,i.TEXTURE_MAG_FILTER,Rt[w.magFilter]),i.texParameteri(P,i.TEXTURE_MIN_FILTER,Rt[w.minFilter]),w.compareFunction&&(i.texParameteri(P,i.TEXTURE_COMPARE_MODE,i.COMPARE_REF_TO_TEXTURE),i.texParameteri(P,i.TEXTURE_COMPARE_FUNC,Pe[w.compareFunction])),e.has("EXT_texture_filter_anisotropic")===!0){if(w.magFilter===Dt||w.minFilter!==bo&&w.minFilter!==Ei||w.type===Cn&&e.has("OES_texture_float_linear")===!1)return;if(w.anisotropy>1||n.get(w).__currentAnisotropy){let V=e.get("EXT_texture_filter_anisotropic");i.texParameterf(P,V.TEXTURE_MAX_ANISOTROPY_EXT,Math.min(w.anisotropy,s.getMaxAnisotropy())),n.get(w).__currentAnisotropy=w.anisotropy}}}function pt(P,w){let V=!1;P.__webglInit===void 0&&(P.__webglInit=!0,w.addEventListener("dispose",R),N(w));let ne=w.source,K=f.get(ne);K===void 0&&(K={},f.set(ne,K));let re=Z(w);if(re!==P.__cacheKey){K[re]===void 0&&(K[re]={texture:i.createTexture(),usedTimes:0},o.memory.textures++,V=!0),K[re].usedTimes++;let ue=K[P.__cacheKey];ue!==void 0&&(K[P.__cacheKey].usedTimes--,ue.usedTimes===0&&W(w)),P.__cacheKey=re,P.__webglTexture=K[re].texture}return V}function je(P,w,V){return Math.floor(Math.floor(P/V)/w)}function qt(P,w,V,ne){let re=P.updateRanges;if(re.length===0)t.texSubImage2D(i.TEXTURE_2D,0,0,0,w.width,w.height,V,ne,w.data);else{re.sort((D,J)=>D.start-J.start);let ue=0;for(let D=1;D<re.length;D++){let J=re[ue],$=re[D],le=J.start+J.count,se=je($.start,w.width,4),oe=je(J.start,w.width,4);$.start<=le+1&&se===oe&&je($.start+$.count-1,w.width,4)===se?J.count=Math.max(J.count,$.start+$.count-J.start):(++ue,re[ue]=$)}re.length=ue+1;let Y=t.getParameter(i.UNPACK_ROW_LENGTH),j=t.getParameter(i.UNPACK_SKIP_PIXELS),ae=t.getParameter(i.UNPACK_SKIP_ROWS);t.pixelStorei(i.UNPACK_ROW_LENGTH,w.width);for(let D=0,J=re.length;D<J;D++){let $=re[D],le=Math.floor($.start/4),se=Math.ceil($.count/4),oe=le%w.width,Ae=Math.floor(le/w.width),He=se,ie=1;t.pixelStorei(i.UNPACK_SKIP_PIXELS,oe),t.pixelStorei(i.UNPACK_SKIP_ROWS,Ae),t.texSubImage2D(i.TEXTURE_2D,0,oe,Ae,He,ie,V,ne,w.data)}P.clearUpdateRanges(),t.pixelStorei(i.UNPACK_ROW_LENGTH,Y),t.pixelStorei(i.UNPACK_SKIP_PIXELS,j),t.pixelStorei(i.UNPACK_SKIP_ROWS,ae)}}function Ot(P,w,V){let ne=i.TEXTURE_2D;(w.isDataArrayTexture||w.isCompressedArrayTexture)&&(ne=i.TEXTURE_2D_ARRAY),w.isData3DTexture&&(ne=i.TEXTURE_3D);let K=pt(P,w),re=w.source;t.bindTexture(ne,P.__webglTexture,i.TEXTURE0+V);let ue=n.get(re);if(re.version!==ue.__version||K===!0){if(t.activeTexture(i.TEXTURE0+V),(typeof ImageBitmap<"u"&&w.image instanceof ImageBitmap)===!1){let ie=$e.getPrimaries($e.workingColorSpace),Ee=w.colorSpace===Ri?null:$e.getPrimaries(w.colorSpace),Ge=w.colorSpace===Ri||ie===Ee?i.NONE:i.BROWSER_DEFAULT_WEBGL;t.pixelStorei(i.UNPACK_FLIP_Y_WEBGL,w.flipY),t.pixelStorei(i.UNPACK_PREMULTIPLY_ALPHA_WEBGL,w.premultiplyAlpha),t.pixelStorei(i.UNPACK_COLORSPACE_CONVERSION_WEBGL,Ge)}t.pixelStorei(i.UNPACK_ALIGNMENT,w.unpackAlignment);let j=x(w.image,!1,s.maxTextureSize);j=Ie(w,j);let ae=r.convert(w.format,w.colorSpace),D=r.convert(w.type),J=A(w.internalFormat,ae,D,w.normalized,w.colorSpace,w.isVideoTexture);nt(ne,w);let $,le=w.mipmaps,se=w.isVideoTexture!==!0,oe=ue.__version===void 0||K===!0,Ae=re.dataReady,He=S(w,j);if(w.isDepthTexture)J=y(w.format===Ci,w.type),oe&&(se?t.texStorage2D(i.TEXTURE_2D,1,J,j.width,j.height):t.texImage2D(i.TEXTURE_2D,0,J,j.width,j.height,0,ae,D,null));else if(w.isDataTexture)if(le.length>0){se&&oe&&t.texStorage2D(i.TEXTURE_2D,He,J,le[0].width,le[0].height);for(let ie=0,Ee=le.length;ie<Ee;ie++)$=le[ie],se?Ae&&t.texSubImage2D(i.TEXTURE_2D,ie,0,0,$.width,$.height,ae,D,$.data):t.texImage2D(i.TEXTURE_2D,ie,J,$.width,$.height,0,ae,D,$.data);w.generateMipmaps=!1}else se?(oe&&t.texStorage2D(i.TEXTURE_2D,He,J,j.width,j.height),Ae&&qt(w,j,ae,D)):t.texImage2D(i.TEXTURE_2D,0,J,j.width,j.height,0,ae,D,j.data);else if(w.isCompressedTexture)if(w.isCompressedArrayTexture){se&&oe&&t.texStorage3D(i.TEXTURE_2D_ARRAY,He,J,le[0].width,le[0].height,j.depth);for(let ie=0,Ee=le.length;ie<Ee;ie++)if($=le[ie],w.format!==Rn)if(ae!==null)if(se){if(Ae)if(w.layerUpdates.size>0){let Ge=Qu($.width,$.height,w.format,w.type);for(let me of w.layerUpdates){let dt=$.data.subarray(me*Ge/$.data.BYTES_PER_ELEMENT,(me+1)*Ge/$.data.BYTES_PER_ELEMENT);t.compressedTexSubImage3D(i.TEXTURE_2D_ARRAY,ie,0,0,me,$.width,$.height,1,ae,dt)}}else t.compressedTexSubImage3D(i.TEXTURE_2D_ARRAY,ie,0,0,0,$.width,$.height,j.depth,ae,$.data)}else t.compressedTexImage3D(i.TEXTURE_2D_ARRAY,ie,J,$.width,$.height,j.depth,0,$.data,0,0);else Re("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()");else se?Ae&&t.texSubImage3D(i.TEXTURE_2D_ARRAY,ie,0,0,0,$.width,$.height,j.depth,ae,D,$.data):t.texImage3D(i.TEXTURE_2D_ARRAY,ie,J,$.width,$.height,j.depth,0,ae,D,$.data);w.layerUpdates.size>0&&w.clearLayerUpdates()}else{se&&oe&&t.texStorage2D(i.TEXTURE_2D,He,J,le[0].width,le[0].height);for(let ie=0,Ee=le.length;ie<Ee;ie++)$=le[ie],w.format!==Rn?ae!==null?se?Ae&&t.compressedTexSubImage2D(i.TEXTURE_2D,ie,0,0,$.width,$.height,ae,$.data):t.compressedTexImage2D(i.TEXTURE_2D,ie,J,$.width,$.height,0,$.data):Re("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()"):se?Ae&&t.texSubImage2D(i.TEXTURE_2D,ie,0,0,$.width,$.height,ae,D,$.data):t.texImage2D(i.TEXTURE_2D,ie,J,$.width,$.height,0,ae,D,$.data)}else if(w.isDataArrayTexture)if(se){if(oe&&t.texStorage3D(i.TEXTURE_2D_ARRAY,He,J,j.width,j.height,j.depth),Ae)if(w.layerUpdates.size>0){let ie=Qu(j.width,j.height,w.format,w.type);for(let Ee of w.layerUpdates){let Ge=j.data.subarray(Ee*ie/j.data.BYTES_PER_ELEMENT,(Ee+1)*ie/j.data.BYTES_PER_ELEMENT);t.texSubImage3D(i.TEXTURE_2D_ARRAY,0,0,0,Ee,j.width,j.height,1,ae,D,Ge)}w.clearLayerUpdates()}else t.texSubImage3D(i.TEXTURE_2D_ARRAY,0,0,0,0,j.width,j.height,j.depth,ae,D,j.data)}else t.texImage3D(i.TEXTURE_2D_ARRAY,0,J,j.width,j.height,j.depth,0,ae,D,j.data);else if(w.isData3DTexture)se?(oe&&t.texStorage3D(i.TEXTURE_3D,He,J,j.width,j.height,j.depth),Ae&&t.texSubImage3D(i.TEXTURE_3D,0,0,0,0,j.width,j.height,j.depth,ae,D,j.data)):t.texImage3D(i.TEXTURE_3D,0,J,j.width,j.height,j.depth,0,ae,D,j.data);else if(w.isFramebufferTexture){if(oe)if(se)t.texStorage2D(i.TEXTURE_2D,He,J,j.width,j.height);else{let ie=j.width,Ee=j.height;for(let Ge=0;Ge<He;Ge++)t.texImage2D(i.TEXTURE_2D,Ge,J,ie,Ee,0,ae,D,null),ie>>=1,Ee>>=1}}else if(w.isHTMLTexture){if("texElementImage2D"in i){let ie=i.canvas;if(ie.hasAttribute("layoutsubtree")||ie.setAttribute("layoutsubtree","true"),j.parentNode!==ie){ie.appendChild(j),u.add(w),ie.onpaint=Ee=>{let Ge=Ee.changedElements;for(let me of u)Ge.includes(me.image)&&(me.needsUpdate=!0)},ie.requestPaint();return}if(i.texElementImage2D.length===3)i.texElementImage2D(i.TEXTURE_2D,i.RGBA8,j);else{let Ge=i.RGBA,me=i.RGBA,dt=i.UNSIGNED_BYTE;i.texElementImage2D(i.TEXTURE_2D,0,Ge,me,dt,j)}i.texParameteri(i.TEXTURE_2D,i.TEXTURE_MIN_FILTER,i.LINEAR),i.texParameteri(i.TEXTURE_2D,i.TEXTURE_WRAP_S,i.CLAMP_TO_EDGE),i.texParameteri(i.TEXTURE_2D,i.TEXTURE_WRAP_T,i.CLAMP_TO_EDGE)}}else if(le.length>0){if(se&&oe){let ie=Be(le[0]);t.texStorage2D(i.TEXTURE_2D,He,J,ie.width,ie.height)}for(let ie=0,Ee=le.length;ie<Ee;ie++)$=le[ie],se?Ae&&t.texSubImage2D(i.TEXTURE_2D,ie,0,0,ae,D,$):t.texImage2D(i.TEXTURE_2D,ie,J,ae,D,$);w.generateMipmaps=!1}else if(se){if(oe){let ie=Be(j);t.texStorage2D(i.TEXTURE_2D,He,J,ie.width,ie.height)}Ae&&t.texSubImage2D(i.TEXTURE_2D,0,0,0,ae,D,j)}else t.texImage2D(i.TEXTURE_2D,0,J,ae,D,j);b(w)&&w.mipmapsAutoUpdate===!0&&_(ne),ue.__version=re.version,w.onUpdate&&w.onUpdate(w)}P.__version=w.version}function Mn(P,w,V){if(w.image.length!==6)return;let ne=pt(P,w),K=w.source;t.bindTexture(i.TEXTURE_CUBE_MAP,P.__webglTexture,i.TEXTURE0+V);let re=n.get(K);if(K.version!==re.__version||ne===!0){t.activeTexture(i.TEXTURE0+V);let ue=$e.getPrimaries($e.workingColorSpace),Y=w.colorSpace===Ri?null:$e.getPrimaries(w.colorSpace),j=w.colorSpace===Ri||ue===Y?i.NONE:i.BROWSER_DEFAULT_WEBGL;t.pixelStorei(i.UNPACK_FLIP_Y_WEBGL,w.flipY),t.pixelStorei(i.UNPACK_PREMULTIPLY_ALPHA_WEBGL,w.premultiplyAlpha),t.pixelStorei(i.UNPACK_ALIGNMENT,w.unpackAlignment),t.pixelStorei(i.UNPACK_COLORSPACE_CONVERSION_WEBGL,j);let ae=w.isCompressedTexture||w.image[0].isCompressedTexture,D=w.image[0]&&w.image[0].isDataTexture,J=[];for(let me=0;me<6;me++)!ae&&!D?J[me]=x(w.image[me],!0,s.maxCubemapSize):J[me]=D?w.image[me].image:w.image[me],J[me]=Ie(w,J[me]);let $=J[0],le=r.convert(w.format,w.colorSpace),se=r.convert(w.type),oe=A(w.internalFormat,le,se,w.normalized,w.colorSpace),Ae=w.isVideoTexture!==!0,He=re.__version===void 0||ne===!0,ie=K.dataReady,Ee=S(w,$);nt(i.TEXTURE_CUBE_MAP,w);let Ge;if(w.isDepthTexture){if(oe=y(w.format===Ci,w.type),He)if(Ae)t.texStorage2D(i.TEXTURE_CUBE_MAP,1,oe,$.width,$.height);else for(let me=0;me<6;me++)t.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+me,0,oe,$.width,$.height,0,le,se,null)}else if(ae){Ae&&He&&t.texStorage2D(i.TEXTURE_CUBE_MAP,Ee,oe,$.width,$.height);for(let me=0;me<6;me++){Ge=J[me].mipmaps;for(let dt=0;dt<Ge.length;dt++){let Vt=Ge[dt];w.format!==Rn?le!==null?Ae?ie&&t.compressedTexSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+me,dt,0,0,Vt.width,Vt.height,le,Vt.data):t.compressedTexImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+me,dt,oe,Vt.width,Vt.height,0,Vt.data):Re("WebGLRenderer: Attempt to load unsupported compressed texture format in .setTextureCube()"):Ae?ie&&t.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+me,dt,0,0,Vt.width,Vt.height,le,se,Vt.data):t.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+me,dt,oe,Vt.width,Vt.height,0,le,se,Vt.data)}}}else{if(Ge=w.mipmaps,Ae&&He){Ge.length>0&&Ee++;let me=Be(J[0]);t.texStorage2D(i.TEXTURE_CUBE_MAP,Ee,oe,me.width,me.height)}for(let me=0;me<6;me++)if(D){Ae?ie&&t.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+me,0,0,0,J[me].width,J[me].height,le,se,J[me].data):t.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+me,0,oe,J[me].width,J[me].height,0,le,se,J[me].data);for(let dt=0;dt<Ge.length;dt++){let Li=Ge[dt].image[me].image;Ae?ie&&t.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+me,dt+1,0,0,Li.width,Li.height,le,se,Li.data):t.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+me,dt+1,oe,Li.width,Li.height,0,le,se,Li.data)}}else{Ae?ie&&t.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+me,0,0,0,le,se,J[me]):t.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+me,0,oe,le,se,J[me]);for(let dt=0;dt<Ge.length;dt++){let Vt=Ge[dt];Ae?ie&&t.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+me,dt+1,0,0,le,se,Vt.image[me]):t.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+me,dt+1,oe,le,se,Vt.image[me])}}}b(w)&&w.mipmapsAutoUpdate===!0&&_(i.TEXTURE_CUBE_MAP),re.__version=K.version,w.onUpdate&&w.onUpdate(w)}P.__version=w.version}function Tt(P,w,V,ne,K,re){let ue=r.convert(V.format,V.colorSpace),Y=r.convert(V.type),j=A(V.internalFormat,ue,Y,V.normalized,V.colorSpace),ae=n.get(w),D=n.get(V);if(D.__renderTarget=w,!ae.__hasExternalTextures){let J=Math.max(1,w.width>>re),$=Math.max(1,w.height>>re);K===i.TEXTURE_3D||K===i.TEXTURE_2D_ARRAY?t.texImage3D(K,re,j,J,$,w.depth,0,ue,Y,null):t.texImage2D(K,re,j,J,$,0,ue,Y,null)}t.bindFramebuffer(i.FRAMEBUFFER,P),fe(w)?a.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,ne,K,D.__webglTexture,0,Mt(w)):(K===i.TEXTURE_2D||K>=i.TEXTURE_CUBE_MAP_POSITIVE_X&&K<=i.TEXTURE_CUBE_MAP_NEGATIVE_Z)&&i.framebufferTexture2D(i.FRAMEBUFFER,ne,K,D.__webglTexture,re),t.bindFramebuffer(i.FRAMEBUFFER,null)}function si(P,w,V){if(i.bindRenderbuffer(i.RENDERBUFFER,P),w.depthBuffer){let ne=w.depthTexture,K=ne&&ne.isDepthTexture?ne.type:null,re=y(w.stencilBuffer,K),ue=w.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT;fe(w)?a.renderbufferStorageMultisampleEXT(i.RENDERBUFFER,Mt(w),re,w.width,w.height):V?i.renderbufferStorageMultisample(i.RENDERBUFFER,Mt(w),re,w.width,w.height):i.renderbufferStorage(i.RENDERBUFFER,re,w.width,w.height),i.framebufferRenderbuffer(i.FRAMEBUFFER,ue,i.RENDERBUFFER,P)}else{let ne=w.textures;for(let K=0;K<ne.length;K++){let re=ne[K],ue=r.convert(re.format,re.colorSpace),Y=r.convert(re.type),j=A(re.internalFormat,ue,Y,re.normalized,re.colorSpace);fe(w)?a.renderbufferStorageMultisampleEXT(i.RENDERBUFFER,Mt(w),j,w.width,w.height):V?i.renderbufferStorageMultisample(i.RENDERBUFFER,Mt(w),j,w.width,w.height):i.renderbufferStorage(i.RENDERBUFFER,j,w.width,w.height)}}i.bindRenderbuffer(i.RENDERBUFFER,null)}function zt(P,w,V){let ne=w.isWebGLCubeRenderTarget===!0;if(t.bindFramebuffer(i.FRAMEBUFFER,P),!(w.depthTexture&&w.depthTexture.isDepthTexture))throw new Error("THREE.WebGLTextures: renderTarget.depthTexture must be an instance of THREE.DepthTexture.");let K=n.get(w.depthTexture);K.__renderTarget=w;let re=ne?w.depthTexture.image[0]:w.depthTexture.image;(!K.__webglTexture||re.width!==w.width||re.height!==w.height)&&(re.width=w.width,re.height=w.height,w.depthTexture.needsUpdate=!0),ne?pe(w.depthTexture,0):he(w.depthTexture,0);let ue=K.__webglTexture,Y=Mt(w),j=ne?i.TEXTURE_CUBE_MAP_POSITIVE_X+V:i.TEXTURE_2D,ae=w.depthTexture.format===Ci?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT;if(w.depthTexture.format===Ti)fe(w)?a.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,ae,j,ue,0,Y):i.framebufferTexture2D(i.FRAMEBUFFER,ae,j,ue,0);else if(w.depthTexture.format===Ci)fe(w)?a.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,ae,j,ue,0,Y):i.framebufferTexture2D(i.FRAMEBUFFER,ae,j,ue,0);else throw new Error("THREE.WebGLTextures: Unknown depthTexture format.")}function Fn(P){let w=n.get(P),V=P.isWebGLCubeRenderTarget===!0;if(w.__boundDepthTexture!==P.depthTexture){let ne=P.depthTexture;if(w.__depthDisposeCallback&&w.__depthDisposeCallback(),ne){let K=()=>{delete w.__boundDepthTexture,delete w.__depthDisposeCallback,ne.removeEventListener("dispose",K)};ne.addEventListener("dispose",K),w.__depthDisposeCallback=K}w.__boundDepthTexture=ne}if(P.depthTexture&&!w.__autoAllocateDepthBuffer)if(V)for(let ne=0;ne<6;ne++)zt(w.__webglFramebuffer[ne],P,ne);else P.texture.mipmaps.length>0?zt(w.__webglFramebuffer[0],P,0):zt(w.__webglFramebuffer,P,0);else if(V){w.__webglDepthbuffer=[];for(let ne=0;ne<6;ne++)if(t.bindFramebuffer(i.FRAMEBUFFER,w.__webglFramebuffer[ne]),w.__webglDepthbuffer[ne]===void 0)w.__webglDepthbuffer[ne]=i.createRenderbuffer(),si(w.__webglDepthbuffer[ne],P,!1);else{let K=P.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,re=w.__webglDepthbuffer[ne];i.bindRenderbuffer(i.RENDERBUFFER,re),i.framebufferRenderbuffer(i.FRAMEBUFFER,K,i.RENDERBUFFER,re)}}else if(P.texture.mipmaps.length>0?t.bindFramebuffer(i.FRAMEBUFFER,w.__webglFramebuffer[0]):t.bindFramebuffer(i.FRAMEBUFFER,w.__webglFramebuffer),w.__webglDepthbuffer===void 0)w.__webglDepthbuffer=i.createRenderbuffer(),si(w.__webglDepthbuffer,P,!1);else{let K=P.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,re=w.__webglDepthbuffer;i.bindRenderbuffer(i.RENDERBUFFER,re),i.framebufferRenderbuffer(i.FRAMEBUFFER,K,i.RENDERBUFFER,re)}t.bindFramebuffer(i.FRAMEBUFFER,null)}function Bn(P,w,V){let ne=n.get(P);w!==void 0&&Tt(ne.__webglFramebuffer,P,P.texture,i.COLOR_ATTACHMENT0,i.TEXTURE_2D,0),V!==void 0&&Fn(P)}function kn(P){let w=P.texture,V=n.get(P),ne=n.get(w);P.addEventListener("dispose",L),N(P);let K=P.textures,re=P.isWebGLCubeRenderTarget===!0,ue=K.length>1;if(ue||(ne.__webglTexture===void 0&&(ne.__webglTexture=i.createTexture()),ne.__version=w.version,o.memory.textures++),re){V.__webglFramebuffer=[];for(let Y=0;Y<6;Y++)if(w.mipmaps.length>0){V.__webglFramebuffer[Y]=[];for(let j=0;j<w.mipmaps.length;j++)V.__webglFramebuffer[Y][j]=i.createFramebuffer()}else V.__webglFramebuffer[Y]=i.createFramebuffer()}else{if(w.mipmaps.length>0){V.__webglFramebuffer=[];for(let Y=0;Y<w.mipmaps.length;Y++)V.__webglFramebuffer[Y]=i.createFramebuffer()}else V.__webglFramebuffer=i.createFramebuffer();if(ue)for(let Y=0,j=K.length;Y<j;Y++){let ae=n.get(K[Y]);ae.__webglTexture===void 0&&(ae.__webglTexture=i.createTexture(),o.memory.textures++)}if(P.samples>0&&fe(P)===!1){V.__webglMultisampledFramebuffer=i.createFramebuffer(),V.__webglColorRenderbuffer=[],t.bindFramebuffer(i.FRAMEBUFFER,V.__webglMultisampledFramebuffer);for(let Y=0;Y<K.length;Y++){let j=K[Y];V.__webglColorRenderbuffer[Y]=i.createRenderbuffer(),i.bindRenderbuffer(i.RENDERBUFFER,V.__webglColorRenderbuffer[Y]);let ae=r.convert(j.format,j.colorSpace),D=r.convert(j.type),J=A(j.internalFormat,ae,D,j.normalized,j.colorSpace,P.isXRRenderTarget===!0),$=Mt(P);i.renderbufferStorageMultisample(i.RENDERBUFFER,$,J,P.width,P.height),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+Y,i.RENDERBUFFER,V.__webglColorRenderbuffer[Y])}i.bindRenderbuffer(i.RENDERBUFFER,null),P.depthBuffer&&(V.__webglDepthRenderbuffer=i.createRenderbuffer(),si(V.__webglDepthRenderbuffer,P,!0)),t.bindFramebuffer(i.FRAMEBUFFER,null)}}if(re){t.bindTexture(i.TEXTURE_CUBE_MAP,ne.__webglTexture),nt(i.TEXTURE_CUBE_MAP,w);for(let Y=0;Y<6;Y++)if(w.mipmaps.length>0)for(let j=0;j<w.mipmaps.length;j++)Tt(V.__webglFramebuffer[Y][j],P,w,i.COLOR_ATTACHMENT0,i.TEXTURE_CUBE_MAP_POSITIVE_X+Y,j);else Tt(V.__webglFramebuffer[Y],P,w,i.COLOR_ATTACHMENT0,i.TEXTURE_CUBE_MAP_POSITIVE_X+Y,0);b(w)?_(i.TEXTURE_CUBE_MAP):w.mipmaps.length>0&&i.texParameteri(i.TEXTURE_CUBE_MAP,i.TEXTURE_MAX_LEVEL,w.mipmaps.length-1),t.unbindTexture()}else if(ue){for(let Y=0,j=K.length;Y<j;Y++){let ae=K[Y],D=n.get(ae),J=i.TEXTURE_2D;(P.isWebGL3DRenderTarget||P.isWebGLArrayRenderTarget)&&(J=P.isWebGL3DRenderTarget?i.TEXTURE_3D:i.TEXTURE_2D_ARRAY),t.bindTexture(J,D.__webglTexture),nt(J,ae),Tt(V.__webglFramebuffer,P,ae,i.COLOR_ATTACHMENT0+Y,J,0),b(ae)&&_(J)}t.unbindTexture()}else{let Y=i.TEXTURE_2D;if((P.isWebGL3DRenderTarget||P.isWebGLArrayRenderTarget)&&(Y=P.isWebGL3DRenderTarget?i.TEXTURE_3D:i.TEXTURE_2D_ARRAY),t.bindTexture(Y,ne.__webglTexture),nt(Y,w),w.mipmaps.length>0)for(let j=0;j<w.mipmaps.length;j++)Tt(V.__webglFramebuffer[j],P,w,i.COLOR_ATTACHMENT0,Y,j);else Tt(V.__webglFramebuffer,P,w,i.COLOR_ATTACHMENT0,Y,0);b(w)?_(Y):w.mipmaps.length>0&&i.texParameteri(Y,i.TEXTURE_MAX_LEVEL,w.mipmaps.length-1),t.unbindTexture()}P.depthBuffer&&Fn(P)}function B(P){let w=P.textures;for(let V=0,ne=w.length;V<ne;V++){let K=w[V];if(b(K)&&K.mipmapsAutoUpdate===!0){let re=M(P),ue=n.get(K).__webglTexture;t.bindTexture(re,ue),_(re),t.unbindTexture()}}}let zn=[];function bt(P){if(P.samples>0){if(fe(P)===!1){let w=P.textures,V=P.width,ne=P.height,K=i.COLOR_BUFFER_BIT,re=P.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,ue=n.get(P),Y=w.length>1;if(Y)for(let ae=0;ae<w.length;ae++)t.bindFramebuffer(i.FRAMEBUFFER,ue.__webglMultisampledFramebuffer),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+ae,i.RENDERBUFFER,null),t.bindFramebuffer(i.FRAMEBUFFER,ue.__webglFramebuffer),i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0+ae,i.TEXTURE_2D,null,0);t.bindFramebuffer(i.READ_FRAMEBUFFER,ue.__webglMultisampledFramebuffer),P.texture.mipmaps.length>0?t.bindFramebuffer(i.DRAW_FRAMEBUFFER,ue.__webglFramebuffer[0]):t.bindFramebuffer(i.DRAW_FRAMEBUFFER,ue.__webglFramebuffer);for(let ae=0;ae<w.length;ae++){if(P.resolveDepthBuffer&&(P.depthBuffer&&(K|=i.DEPTH_BUFFER_BIT),P.stencilBuffer&&P.resolveStencilBuffer&&(K|=i.STENCIL_BUFFER_BIT)),Y){i.framebufferRenderbuffer(i.READ_FRAMEBUFFER,i.COLOR_ATTACHMENT0,i.RENDERBUFFER,ue.__webglColorRenderbuffer[ae]);let D=n.get(w[ae]).__webglTexture;i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0,i.TEXTURE_2D,D,0)}i.blitFramebuffer(0,0,V,ne,0,0,V,ne,K,i.NEAREST),l===!0&&(zn.length=0,zn.push(i.COLOR_ATTACHMENT0+ae),P.depthBuffer&&P.storeMultisampledDepthBuffer===!1&&zn.push(re),i.invalidateFramebuffer(i.READ_FRAMEBUFFER,zn))}if(t.bindFramebuffer(i.READ_FRAMEBUFFER,null),t.bindFramebuffer(i.DRAW_FRAMEBUFFER,null),Y)for(let ae=0;ae<w.length;ae++){t.bindFramebuffer(i.FRAMEBUFFER,ue.__webglMultisampledFramebuffer),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+ae,i.RENDERBUFFER,ue.__webglColorRenderbuffer[ae]);let D=n.get(w[ae]).__webglTexture;t.bindFramebuffer(i.FRAMEBUFFER,ue.__webglFramebuffer),i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0+ae,i.TEXTURE_2D,D,0)}t.bindFramebuffer(i.DRAW_FRAMEBUFFER,ue.__webglMultisampledFramebuffer)}else if(P.depthBuffer&&P.storeMultisampledDepthBuffer===!1&&l){let w=P.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT;i.invalidateFramebuffer(i.DRAW_FRAMEBUFFER,[w])}}}function Mt(P){return Math.min(s.maxSamples,P.samples)}function fe(P){let w=n.get(P);return P.samples>0&&e.has("WEBGL_multisampled_render_to_texture")===!0&&w.__useRenderToTexture!==!1}function Ut(P){let w=o.render.frame;h.get(P)!==w&&(h.set(P,w),P.update())}function Ie(P,w){let V=P.colorSpace,ne=P.format,K=P.type;return P.isCompressedTexture===!0||P.isVideoTexture===!0||V!==jr&&V!==Ri&&($e.getTransfer(V)===ht?(ne!==Rn||K!==vn)&&Re("WebGLTextures: sRGB encoded textures have to use RGBAFormat and UnsignedByteType."):Ne("WebGLTextures: Unsupported texture color space:",V)),w}function Be(P){return typeof HTMLImageElement<"u"&&P instanceof HTMLImageElement?(c.width=P.naturalWidth||P.width,c.height=P.naturalHeight||P.height):typeof VideoFrame<"u"&&P instanceof VideoFrame?(c.width=P.displayWidth,c.height=P.displayHeight):(c.width=P.width,c.height=P.height),c}this.allocateTextureUnit=Oe,this.resetTextureUnits=Q,this.getTextureUnits=ee,this.setTextureUnits=be,this.setTexture2D=he,this.setTexture2DArray=ve,this.setTexture3D=Ce,this.setTextureCube=pe,this.rebindTextures=Bn,this.setupRenderTarget=kn,this.updateRenderTargetMipmap=B,this.updateMultisampleRenderTarget=bt,this.setupDepthRenderbuffer=Fn,this.setupFrameBufferTexture=Tt,this.useMultisampledRTT=fe,this.dispose=k}function _S(i,e){function t(n,s=Ri){let r,o=$e.getTransfer(s);if(n===vn)return i.UNSIGNED_BYTE;if(n===yl)return i.UNSIGNED_SHORT_4_4_4_4;if(n===xl)return i.UNSIGNED_SHORT_5_5_5_1;if(n===Ou)return i.UNSIGNED_INT_5_9_9_9_REV;if(n===Uu)return i.UNSIGNED_INT_10F_11F_11F_REV;if(n===Nu)return i.BYTE;if(n===Du)return i.SHORT;if(n===or)return i.UNSIGNED_SHORT;if(n===gl)return i.INT;if(n===Wn)return i.UNSIGNED_INT;if(n===Cn)return i.FLOAT;if(n===Qn)return i.HALF_FLOAT;if(n===Fu)return i.ALPHA;if(n===Bu)return i.RGB;if(n===Rn)return i.RGBA;if(n===Ti)return i.DEPTH_COMPONENT;if(n===Ci)return i.DEPTH_STENCIL;if(n===ku)return i.RED;if(n===Mo)return i.RED_INTEGER;if(n===Xi)return i.RG;if(n===_l)return i.RG_INTEGER;if(n===vl)return i.RGBA_INTEGER;if(n===So||n===wo||n===To||n===Ao)if(o===ht)if(r=e.get("WEBGL_compressed_texture_s3tc_srgb"),r!==null){if(n===So)return r.COMPRESSED_SRGB_S3TC_DXT1_EXT;if(n===wo)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT1_EXT;if(n===To)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT3_EXT;if(n===Ao)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT5_EXT}else return null;else if(r=e.get("WEBGL_compressed_texture_s3tc"),r!==null){if(n===So)return r.COMPRESSED_RGB_S3TC_DXT1_EXT;if(n===wo)return r.COMPRESSED_RGBA_S3TC_DXT1_EXT;if(n===To)return r.COMPRESSED_RGBA_S3TC_DXT3_EXT;if(n===Ao)return r.COMPRESSED_RGBA_S3TC_DXT5_EXT}else return null;if(n===bl||n===Ml||n===Sl||n===wl)if(r=e.get("WEBGL_compressed_texture_pvrtc"),r!==null){if(n===bl)return r.COMPRESSED_RGB_PVRTC_4BPPV1_IMG;if(n===Ml)return r.COMPRESSED_RGB_PVRTC_2BPPV1_IMG;if(n===Sl)return r.COMPRESSED_RGBA_PVRTC_4BPPV1_IMG;if(n===wl)return r.COMPRESSED_RGBA_PVRTC_2BPPV1_IMG}else return null;if(n===Tl||n===Al||n===El||n===Cl||n===Rl||n===Eo||n===Pl)if(r=e.get("WEBGL_compressed_texture_etc"),r!==null){if(n===Tl||n===Al)return o===ht?r.COMPRESSED_SRGB8_ETC2:r.COMPRESSED_RGB8_ETC2;if(n===El)return o===ht?r.COMPRESSED_SRGB8_ALPHA8_ETC2_EAC:r.COMPRESSED_RGBA8_ETC2_EAC;if(n===Cl)return r.COMPRESSED_R11_EAC;if(n===Rl)return r.COMPRESSED_SIGNED_R11_EAC;if(n===Eo)return r.COMPRESSED_RG11_EAC;if(n===Pl)return r.COMPRESSED_SIGNED_RG11_EAC}else return null;if(n===Il||n===Ll||n===Nl||n===Dl||n===Ol||n===Ul||n===Fl||n===Bl||n===kl||n===zl||n===Vl||n===Gl||n===Hl||n===Wl)if(r=e.get("WEBGL_compressed_texture_astc"),r!==null){if(n===Il)return o===ht?r.COMPRESSED_SRGB8_ALPHA8_ASTC_4x4_KHR:r.COMPRESSED_RGBA_ASTC_4x4_KHR;if(n===Ll)return o===ht?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x4_KHR:r.COMPRESSED_RGBA_ASTC_5x4_KHR;if(n===Nl)return o===ht?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x5_KHR:r.COMPRESSED_RGBA_ASTC_5x5_KHR;if(n===Dl)return o===ht?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x5_KHR:r.COMPRESSED_RGBA_ASTC_6x5_KHR;if(n===Ol)return o===ht?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x6_KHR:r.COMPRESSED_RGBA_ASTC_6x6_KHR;if(n===Ul)return o===ht?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x5_KHR:r.COMPRESSED_RGBA_ASTC_8x5_KHR;if(n===Fl)return o===ht?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x6_KHR:r.COMPRESSED_RGBA_ASTC_8x6_KHR;if(n===Bl)return o===ht?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x8_KHR:r.COMPRESSED_RGBA_ASTC_8x8_KHR;if(n===kl)return o===ht?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x5_KHR:r.COMPRESSED_RGBA_ASTC_10x5_KHR;if(n===zl)return o===ht?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x6_KHR:r.COMPRESSED_RGBA_ASTC_10x6_KHR;if(n===Vl)return o===ht?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x8_KHR:r.COMPRESSED_RGBA_ASTC_10x8_KHR;if(n===Gl)return o===ht?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x10_KHR:r.COMPRESSED_RGBA_ASTC_10x10_KHR;if(n===Hl)return o===ht?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x10_KHR:r.COMPRESSED_RGBA_ASTC_12x10_KHR;if(n===Wl)return o===ht?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x12_KHR:r.COMPRESSED_RGBA_ASTC_12x12_KHR}else return null;if(n===Xl||n===ql||n===$l)if(r=e.get("EXT_texture_compression_bptc"),r!==null){if(n===Xl)return o===ht?r.COMPRESSED_SRGB_ALPHA_BPTC_UNORM_EXT:r.COMPRESSED_RGBA_BPTC_UNORM_EXT;if(n===ql)return r.COMPRESSED_RGB_BPTC_SIGNED_FLOAT_EXT;if(n===$l)return r.COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT_EXT}else return null;if(n===Yl||n===jl||n===Co||n===Zl)if(r=e.get("EXT_texture_compression_rgtc"),r!==null){if(n===Yl)return r.COMPRESSED_RED_RGTC1_EXT;if(n===jl)return r.COMPRESSED_SIGNED_RED_RGTC1_EXT;if(n===Co)return r.COMPRESSED_RED_GREEN_RGTC2_EXT;if(n===Zl)return r.COMPRESSED_SIGNED_RED_GREEN_RGTC2_EXT}else return null;return n===ms?i.UNSIGNED_INT_24_8:i[n]!==void 0?i[n]:null}return{convert:t}}var vS=`
void main() {

	gl_Position = vec4( position, 1.0 );

}`,bS=`
uniform sampler2DArray depthColor;
uniform float depthWidth;
uniform float depthHeight;

void main() {

	vec2 coord = vec2( gl_FragCoord.x / depthWidth, gl_FragCoord.y / depthHeight );

	if ( coord.x >= 1.0 ) {

		gl_FragDepth = texture( depthColor, vec3( coord.x - 1.0, coord.y, 1 ) ).r;

	} else {

		gl_FragDepth = texture( depthColor, vec3( coord.x, coord.y, 0 ) ).r;

	}

}`,ld=class{constructor(){this.texture=null,this.mesh=null,this.depthNear=0,this.depthFar=0}init(e,t){if(this.texture===null){let n=new co(e.texture);(e.depthNear!==t.depthNear||e.depthFar!==t.depthFar)&&(this.depthNear=e.depthNear,this.depthFar=e.depthFar),this.texture=n}}getMesh(e){if(this.texture!==null&&this.mesh===null){let t=e.cameras[0].viewport,n=new on({vertexShader:vS,fragmentShader:bS,uniforms:{depthColor:{value:this.texture},depthWidth:{value:t.z},depthHeight:{value:t.w}}});this.mesh=new Ke(new In(20,20),n)}return this.mesh}reset(){this.texture=null,this.mesh=null}getDepthTexture(){return this.texture}},cd=class extends li{constructor(e,t){super();let n=this,s=null,r=1,o=null,a="local-floor",l=1,c=null,h=null,u=null,d=null,f=null,p=null,v=typeof XRWebGLBinding<"u",m=new ld,g={},x=t.getContextAttributes(),b=null,_=null,M=[],A=[],y=new _e,S=null,N=null,E=new fn;E.viewport=new Ct;let R=new fn;R.viewport=new Ct;let L=[E,R],O=new dl,I=null,k=null;this.cameraAutoUpdate=!0,this.enabled=!1,this.isPresenting=!1,this.getController=function(Z){let he=M[Z];return he===void 0&&(he=new $s,M[Z]=he),he.getTargetRaySpace()},this.getControllerGrip=function(Z){let he=M[Z];return he===void 0&&(he=new $s,M[Z]=he),he.getGripSpace()},this.getHand=function(Z){let he=M[Z];return he===void 0&&(he=new $s,M[Z]=he),he.getHandSpace()};function H(Z){let he=A.indexOf(Z.inputSource);if(he===-1)return;let ve=M[he];ve!==void 0&&(ve.update(Z.inputSource,Z.frame,c||o),ve.dispatchEvent({type:Z.type,data:Z.inputSource}))}function W(){s.removeEventListener("select",H),s.removeEventListener("selectstart",H),s.removeEventListener("selectend",H),s.removeEventListener("squeeze",H),s.removeEventListener("squeezestart",H),s.removeEventListener("squeezeend",H),s.removeEventListener("end",W),s.removeEventListener("inputsourceschange",te);for(let Z=0;Z<M.length;Z++){let he=A[Z];he!==null&&(A[Z]=null,M[Z].disconnect(he))}I=null,k=null,m.reset();for(let Z in g)delete g[Z];if(e.setRenderTarget(b),f=null,d=null,u=null,s=null,_=null,Oe.stop(),n.isPresenting=!1,e.setPixelRatio(S),e.setSize(y.width,y.height,!1),N!==null){let Z=N.camera;Z.fov=N.fov,Z.zoom=N.zoom,Z.updateProjectionMatrix(),N=null}n.dispatchEvent({type:"sessionend"})}this.setFramebufferScaleFactor=function(Z){r=Z,n.isPresenting===!0&&Re("WebXRManager: Cannot change framebuffer scale while presenting.")},this.setReferenceSpaceType=function(Z){a=Z,n.isPresenting===!0&&Re("WebXRManager: Cannot change reference space type while presenting.")},this.getReferenceSpace=function(){return c||o},this.setReferenceSpace=function(Z){c=Z},this.getBaseLayer=function(){return d!==null?d:f},this.getBinding=function(){return u===null&&v&&(u=new XRWebGLBinding(s,t)),u},this.getFrame=function(){return p},this.getSession=function(){return s},this.setSession=async function(Z){if(s=Z,s!==null){if(b=e.getRenderTarget(),s.addEventListener("select",H),s.addEventListener("selectstart",H),s.addEventListener("selectend",H),s.addEventListener("squeeze",H),s.addEventListener("squeezestart",H),s.addEventListener("squeezeend",H),s.addEventListener("end",W),s.addEventListener("inputsourceschange",te),x.xrCompatible!==!0&&await t.makeXRCompatible(),S=e.getPixelRatio(),e.getSize(y),v&&"createProjectionLayer"in XRWebGLBinding.prototype){let ve=null,Ce=null,pe=null;x.depth&&(pe=x.stencil?t.DEPTH24_STENCIL8:t.DEPTH_COMPONENT24,ve=x.stencil?Ci:Ti,Ce=x.stencil?ms:Wn);let Fe={colorFormat:t.RGBA8,depthFormat:pe,scaleFactor:r};u=this.getBinding(),d=u.createProjectionLayer(Fe),s.updateRenderState({layers:[d]}),e.setPixelRatio(1),e.setSize(d.textureWidth,d.textureHeight,!1),_=new gn(d.textureWidth,d.textureHeight,{format:Rn,type:vn,depthTexture:new Ai(d.textureWidth,d.textureHeight,Ce,void 0,void 0,void 0,void 0,void 0,void 0,ve),stencilBuffer:x.stencil,colorSpace:e.outputColorSpace,samples:x.antialias?4:0,resolveDepthBuffer:d.ignoreDepthValues===!1,resolveStencilBuffer:d.ignoreDepthValues===!1,storeMultisampledDepthBuffer:d.ignoreDepthValues===!1,storeMultisampledStencilBuffer:d.ignoreDepthValues===!1})}else{let ve={antialias:x.antialias,alpha:!0,depth:x.depth,stencil:x.stencil,framebufferScaleFactor:r};f=new XRWebGLLayer(s,t,ve),s.updateRenderState({baseLayer:f}),e.setPixelRatio(1),e.setSize(f.framebufferWidth,f.framebufferHeight,!1),_=new gn(f.framebufferWidth,f.framebufferHeight,{format:Rn,type:vn,colorSpace:e.outputColorSpace,stencilBuffer:x.stencil,resolveDepthBuffer:f.ignoreDepthValues===!1,resolveStencilBuffer:f.ignoreDepthValues===!1,storeMultisampledDepthBuffer:f.ignoreDepthValues===!1,storeMultisampledStencilBuffer:f.ignoreDepthValues===!1})}_.isXRRenderTarget=!0,this.setFoveation(l),c=null,o=await s.requestReferenceSpace(a),Oe.setContext(s),Oe.start(),n.isPresenting=!0,n.dispatchEvent({type:"sessionstart"})}},this.getEnvironmentBlendMode=function(){if(s!==null)return s.environmentBlendMode},this.getDepthTexture=function(){return m.getDepthTexture()};function te(Z){for(let he=0;he<Z.removed.length;he++){let ve=Z.removed[he],Ce=A.indexOf(ve);Ce>=0&&(A[Ce]=null,M[Ce].disconnect(ve))}for(let he=0;he<Z.added.length;he++){let ve=Z.added[he],Ce=A.indexOf(ve);if(Ce===-1){for(let Fe=0;Fe<M.length;Fe++)if(Fe>=A.length){A.push(ve),Ce=Fe;break}else if(A[Fe]===null){A[Fe]=ve,Ce=Fe;break}if(Ce===-1)break}let pe=M[Ce];pe&&pe.connect(ve)}}function q(Z,he){he===null?Z.matrixWorld.copy(Z.matrix):Z.matrixWorld.multiplyMatrices(he.matrixWorld,Z.matrix),Z.matrixWorldInverse.copy(Z.matrixWorld).invert()}this.updateCamera=function(Z){if(s===null)return;let he=Z.near,ve=Z.far;m.texture!==null&&(m.depthNear>0&&(he=m.depthNear),m.depthFar>0&&(ve=m.depthFar)),O.near=R.near=E.near=he,O.far=R.far=E.far=ve,(I!==O.near||k!==O.far)&&(s.updateRenderState({depthNear:O.near,depthFar:O.far}),I=O.near,k=O.far),O.layers.mask=Z.layers.mask|6,E.layers.mask=O.layers.mask&-5,R.layers.mask=O.layers.mask&-3;let Ce=Z.parent,pe=O.cameras;q(O,Ce);for(let Fe=0;Fe<pe.length;Fe++)q(pe[Fe],Ce);O.projectionMatrix.copy(E.projectionMatrix),O.projectionMatrixInverse.copy(E.projectionMatrixInverse),N===null&&Z.isPerspectiveCamera&&(N={camera:Z,fov:Z.fov,zoom:Z.zoom}),Q(Z,O,Ce)};function Q(Z,he,ve){ve===null?Z.matrix.copy(he.matrixWorld):(Z.matrix.copy(ve.matrixWorld),Z.matrix.invert(),Z.matrix.multiply(he.matrixWorld)),Z.matrix.decompose(Z.position,Z.quaternion,Z.scale),Z.updateMatrixWorld(!0),Z.projectionMatrix.copy(he.projectionMatrix),Z.projectionMatrixInverse.copy(he.projectionMatrixInverse),Z.isPerspectiveCamera&&(Z.fov=Ws*2*Math.atan(1/Z.projectionMatrix.elements[5]),Z.zoom=1)}this.getCamera=function(){return O},this.getFoveation=function(){if(!(d===null&&f===null))return l},this.setFoveation=function(Z){l=Z,d!==null&&(d.fixedFoveation=Z),f!==null&&f.fixedFoveation!==void 0&&(f.fixedFoveation=Z)},this.hasDepthSensing=function(){return m.texture!==null},this.getDepthSensingMesh=function(){return m.getMesh(O)},this.getCameraTexture=function(Z){return g[Z]};let ee=null;function be(Z,he){if(h=he.getViewerPose(c||o),p=he,h!==null){let ve=h.views;f!==null&&(e.setRenderTargetFramebuffer(_,f.framebuffer),e.setRenderTarget(_));let Ce=!1;ve.length!==O.cameras.length&&(O.cameras.length=0,Ce=!0);for(let Pe=0;Pe<ve.length;Pe++){let nt=ve[Pe],pt=null;if(f!==null)pt=f.getViewport(nt);else{let qt=u.getViewSubImage(d,nt);pt=qt.viewport,Pe===0&&(e.setRenderTargetTextures(_,qt.colorTexture,qt.depthStencilTexture),e.setRenderTarget(_))}let je=L[Pe];je===void 0&&(je=new fn,je.layers.enable(Pe),je.viewport=new Ct,L[Pe]=je),je.matrix.fromArray(nt.transform.matrix),je.matrix.decompose(je.position,je.quaternion,je.scale),je.projectionMatrix.fromArray(nt.projectionMatrix),je.projectionMatrixInverse.copy(je.projectionMatrix).invert(),je.viewport.set(pt.x,pt.y,pt.width,pt.height),Pe===0&&(O.matrix.copy(je.matrix),O.matrix.decompose(O.position,O.quaternion,O.scale)),Ce===!0&&O.cameras.push(je)}let pe=s.enabledFeatures;if(pe&&pe.includes("depth-sensing")&&s.depthUsage=="gpu-optimized"&&v){u=n.getBinding();let Pe=u.getDepthInformation(ve[0]);Pe&&Pe.isValid&&Pe.texture&&m.init(Pe,s.renderState)}if(pe&&pe.includes("camera-access")&&v){e.state.unbindTexture(),u=n.getBinding();for(let Pe=0;Pe<ve.length;Pe++){let nt=ve[Pe].camera;if(nt){let pt=g[nt];pt||(pt=new co,g[nt]=pt);let je=u.getCameraImage(nt);pt.sourceTexture=je}}}}for(let ve=0;ve<M.length;ve++){let Ce=A[ve],pe=M[ve];Ce!==null&&pe!==void 0&&pe.update(Ce,he,c||o)}ee&&ee(Z,he),he.detectedPlanes&&n.dispatchEvent({type:"planesdetected",data:he}),p=null}let Oe=new Tm;Oe.setAnimationLoop(be),this.setAnimationLoop=function(Z){ee=Z},this.dispose=function(){}}},MS=new Le,Om=new Ue;Om.set(-1,0,0,0,1,0,0,0,1);function SS(i,e){function t(m,g){m.matrixAutoUpdate===!0&&m.updateMatrix(),g.value.copy(m.matrix)}function n(m,g){g.color.getRGB(m.fogColor.value,Zu(i)),g.isFog?(m.fogNear.value=g.near,m.fogFar.value=g.far):g.isFogExp2&&(m.fogDensity.value=g.density)}function s(m,g,x,b,_){g.isNodeMaterial?g.uniformsNeedUpdate=!1:g.isMeshBasicMaterial?r(m,g):g.isMeshLambertMaterial?(r(m,g),g.envMap&&(m.envMapIntensity.value=g.envMapIntensity)):g.isMeshToonMaterial?(r(m,g),u(m,g)):g.isMeshPhongMaterial?(r(m,g),h(m,g),g.envMap&&(m.envMapIntensity.value=g.envMapIntensity)):g.isMeshStandardMaterial?(r(m,g),d(m,g),g.isMeshPhysicalMaterial&&f(m,g,_)):g.isMeshMatcapMaterial?(r(m,g),p(m,g)):g.isMeshDepthMaterial?r(m,g):g.isMeshDistanceMaterial?(r(m,g),v(m,g)):g.isMeshNormalMaterial?r(m,g):g.isLineBasicMaterial?(o(m,g),g.isLineDashedMaterial&&a(m,g)):g.isPointsMaterial?l(m,g,x,b):g.isSpriteMaterial?c(m,g):g.isShadowMaterial?(m.color.value.copy(g.color),m.opacity.value=g.opacity):g.isShaderMaterial&&(g.uniformsNeedUpdate=!1)}function r(m,g){m.opacity.value=g.opacity,g.color&&m.diffuse.value.copy(g.color),g.emissive&&m.emissive.value.copy(g.emissive).multiplyScalar(g.emissiveIntensity),g.map&&(m.map.value=g.map,t(g.map,m.mapTransform)),g.alphaMap&&(m.alphaMap.value=g.alphaMap,t(g.alphaMap,m.alphaMapTransform)),g.bumpMap&&(m.bumpMap.value=g.bumpMap,t(g.bumpMap,m.bumpMapTransform),m.bumpScale.value=g.bumpScale,g.side===Zt&&(m.bumpScale.value*=-1)),g.normalMap&&(m.normalMap.value=g.normalMap,t(g.normalMap,m.normalMapTransform),m.normalScale.value.copy(g.normalScale),g.side===Zt&&m.normalScale.value.negate()),g.displacementMap&&(m.displacementMap.value=g.displacementMap,t(g.displacementMap,m.displacementMapTransform),m.displacementScale.value=g.displacementScale,m.displacementBias.value=g.displacementBias),g.emissiveMap&&(m.emissiveMap.value=g.emissiveMap,t(g.emissiveMap,m.emissiveMapTransform)),g.specularMap&&(m.specularMap.value=g.specularMap,t(g.specularMap,m.specularMapTransform)),g.alphaTest>0&&(m.alphaTest.value=g.alphaTest);let x=e.get(g),b=x.envMap,_=x.envMapRotation;b&&(m.envMap.value=b,m.envMapRotation.value.setFromMatrix4(MS.makeRotationFromEuler(_)).transpose(),b.isCubeTexture&&b.isRenderTargetTexture===!1&&m.envMapRotation.value.premultiply(Om),m.reflectivity.value=g.reflectivity,m.ior.value=g.ior,m.refractionRatio.value=g.refractionRatio),g.lightMap&&(m.lightMap.value=g.lightMap,m.lightMapIntensity.value=g.lightMapIntensity,t(g.lightMap,m.lightMapTransform)),g.aoMap&&(m.aoMap.value=g.aoMap,m.aoMapIntensity.value=g.aoMapIntensity,t(g.aoMap,m.aoMapTransform))}function o(m,g){m.diffuse.value.copy(g.color),m.opacity.value=g.opacity,g.map&&(m.map.value=g.map,t(g.map,m.mapTransform))}function a(m,g){m.dashSize.value=g.dashSize,m.totalSize.value=g.dashSize+g.gapSize,m.scale.value=g.scale}function l(m,g,x,b){m.diffuse.value.copy(g.color),m.opacity.value=g.opacity,m.size.value=g.size*x,m.scale.value=b*.5,g.map&&(m.map.value=g.map,t(g.map,m.uvTransform)),g.alphaMap&&(m.alphaMap.value=g.alphaMap,t(g.alphaMap,m.alphaMapTransform)),g.alphaTest>0&&(m.alphaTest.value=g.alphaTest)}function c(m,g){m.diffuse.value.copy(g.color),m.opacity.value=g.opacity,m.rotation.value=g.rotation,g.map&&(m.map.value=g.map,t(g.map,m.mapTransform)),g.alphaMap&&(m.alphaMap.value=g.alphaMap,t(g.alphaMap,m.alphaMapTransform)),g.alphaTest>0&&(m.alphaTest.value=g.alphaTest)}function h(m,g){m.specular.value.copy(g.specular),m.shininess.value=Math.max(g.shininess,1e-4)}function u(m,g){g.gradientMap&&(m.gradientMap.value=g.gradientMap)}function d(m,g){m.metalness.value=g.metalness,g.metalnessMap&&(m.metalnessMap.value=g.metalnessMap,t(g.metalnessMap,m.metalnessMapTransform)),m.roughness.value=g.roughness,g.roughnessMap&&(m.roughnessMap.value=g.roughnessMap,t(g.roughnessMap,m.roughnessMapTransform)),g.envMap&&(m.envMapIntensity.value=g.envMapIntensity)}function f(m,g,x){m.ior.value=g.ior,g.diffuseRoughness>0&&(m.diffuseRoughness.value=g.diffuseRoughness,g.diffuseRoughnessMap&&(m.diffuseRoughnessMap.value=g.diffuseRoughnessMap,t(g.diffuseRoughnessMap,m.diffuseRoughnessMapTransform))),g.sheen>0&&(m.sheenColor.value.copy(g.sheenColor).multiplyScalar(g.sheen),m.sheenRoughness.value=g.sheenRoughness,g.sheenColorMap&&(m.sheenColorMap.value=g.sheenColorMap,t(g.sheenColorMap,m.sheenColorMapTransform)),g.sheenRoughnessMap&&(m.sheenRoughnessMap.value=g.sheenRoughnessMap,t(g.sheenRoughnessMap,m.sheenRoughnessMapTransform))),g.clearcoat>0&&(m.clearcoat.value=g.clearcoat,m.clearcoatRoughness.value=g.clearcoatRoughness,g.clearcoatMap&&(m.clearcoatMap.value=g.clearcoatMap,t(g.clearcoatMap,m.clearcoatMapTransform)),g.clearcoatRoughnessMap&&(m.clearcoatRoughnessMap.value=g.clearcoatRoughnessMap,t(g.clearcoatRoughnessMap,m.clearcoatRoughnessMapTransform)),g.clearcoatNormalMap&&(m.clearcoatNormalMap.value=g.clearcoatNormalMap,t(g.clearcoatNormalMap,m.clearcoatNormalMapTransform),m.clearcoatNormalScale.value.copy(g.clearcoatNormalScale),g.side===Zt&&m.clearcoatNormalScale.value.negate())),g.dispersion>0&&(m.dispersion.value=g.dispersion),g.retroreflectivity>0&&(m.retroreflectivity.value=g.retroreflectivity),g.iridescence>0&&(m.iridescence.value=g.iridescence,m.iridescenceIOR.value=g.iridescenceIOR,m.iridescenceThicknessMinimum.value=g.iridescenceThicknessMinimum,m.iridescenceThicknessMaximum.value=g.iridescenceThicknessMaximum,g.iridescenceMap&&(m.iridescenceMap.value=g.iridescenceMap,t(g.iridescenceMap,m.iridescenceMapTransform)),g.iridescenceThicknessMap&&(m.iridescenceThicknessMap.value=g.iridescenceThicknessMap,t(g.iridescenceThicknessMap,m.iridescenceThicknessMapTransform))),g.transmission>0&&(m.transmission.value=g.transmission,m.transmissionSamplerMap.value=x.texture,m.transmissionSamplerSize.value.set(x.width,x.height),g.transmissionMap&&(m.transmissionMap.value=g.transmissionMap,t(g.transmissionMap,m.transmissionMapTransform)),m.thickness.value=g.thickness,g.thicknessMap&&(m.thicknessMap.value=g.thicknessMap,t(g.thicknessMap,m.thicknessMapTransform)),m.attenuationDistance.value=g.attenuationDistance,m.attenuationColor.value.copy(g.attenuationColor)),g.anisotropy>0&&(m.anisotropyVector.value.set(g.anisotropy*Math.cos(g.anisotropyRotation),g.anisotropy*Math.sin(g.anisotropyRotation)),g.anisotropyMap&&(m.anisotropyMap.value=g.anisotropyMap,t(g.anisotropyMap,m.anisotropyMapTransform))),m.specularIntensity.value=g.specularIntensity,m.specularColor.value.copy(g.specularColor),g.specularColorMap&&(m.specularColorMap.value=g.specularColorMap,t(g.specularColorMap,m.specularColorMapTransform)),g.specularIntensityMap&&(m.specularIntensityMap.value=g.specularIntensityMap,t(g.specularIntensityMap,m.specularIntensityMapTransform))}function p(m,g){g.matcap&&(m.matcap.value=g.matcap)}function v(m,g){let x=e.get(g).light;m.referencePosition.value.setFromMatrixPosition(x.matrixWorld),m.nearDistance.value=x.shadow.camera.near,m.farDistance.value=x.shadow.camera.far}return{refreshFogUniforms:n,refreshMaterialUniforms:s}}function wS(i,e,t,n){let s={},r={};function o(x,b){let _=b.program;n.uniformBlockBinding(x,_,s[x.id])}function a(x,b){let _=s[x.id];_===void 0&&(p(x),_=l(x),s[x.id]=_,x.addEventListener("dispose",m));let M=b.program;n.updateUBOMapping(x,M);let A=e.render.frame;r[x.id]!==A&&(c(x),r[x.id]=A)}function l(x){let b=i.createBuffer(),_=x.__size,M=x.usage;return i.bindBuffer(i.UNIFORM_BUFFER,b),i.bufferData(i.UNIFORM_BUFFER,_,M),i.bindBuffer(i.UNIFORM_BUFFER,null),b}function c(x){let b=s[x.id],_=x.uniforms,M=x.__cache;i.bindBuffer(i.UNIFORM_BUFFER,b);for(let A=0,y=_.length;A<y;A++){let S=_[A];if(Array.isArray(S))for(let N=0,E=S.length;N<E;N++)h(S[N],A,N,M);else h(S,A,0,M)}i.bindBuffer(i.UNIFORM_BUFFER,null)}function h(x,b,_,M){if(d(x,b,_,M)===!0){let A=x.__offset,y=x.value;if(Array.isArray(y)){let S=0;for(let N=0;N<y.length;N++){let E=y[N],R=v(E,!0);u(E,x.__data,S),S+=R.storage/Float32Array.BYTES_PER_ELEMENT}}else u(y,x.__data,0);i.bufferSubData(i.UNIFORM_BUFFER,A,x.__data)}}function u(x,b,_){typeof x=="number"||typeof x=="boolean"?b[_]=x:x.isMatrix3?(b[_]=x.elements[0],b[_+1]=x.elements[1],b[_+2]=x.elements[2],b[_+3]=0,b[_+4]=x.elements[3],b[_+5]=x.elements[4],b[_+6]=x.elements[5],b[_+7]=0,b[_+8]=x.elements[6],b[_+9]=x.elements[7],b[_+10]=x.elements[8],b[_+11]=0):ArrayBuffer.isView(x)?b.set(x.subarray(0,b.length-_),_):x.toArray(b,_)}function d(x,b,_,M){let A=x.value,y=b+"_"+_;if(Array.isArray(A)){M[y]===void 0&&(M[y]=[]);let S=M[y],N=!1;for(let E=0;E<A.length;E++)f(A[E],S,E)===!0&&(N=!0);return N}return f(A,M,y)}function f(x,b,_){if(b[_]===void 0)return typeof x=="number"||typeof x=="boolean"?b[_]=x:ArrayBuffer.isView(x)?b[_]=x.slice():b[_]=x.clone(),!0;{let M=b[_];if(typeof x=="number"||typeof x=="boolean"){if(M!==x)return b[_]=x,!0}else{if(ArrayBuffer.isView(x))return!0;if(M.equals(x)===!1)return M.copy(x),!0}}return!1}function p(x){let b=x.uniforms,_=0,M=16;for(let y=0,S=b.length;y<S;y++){let N=Array.isArray(b[y])?b[y]:[b[y]];for(let E=0,R=N.length;E<R;E++){let L=N[E],O=Array.isArray(L.value)?L.value:[L.value],I=Array.isArray(b[y])||Array.isArray(L.value),k=_;for(let W=0,te=O.length;W<te;W++){let q=O[W],Q=v(q,I),ee=_%M,be=ee%Q.boundary,Oe=ee+be;_+=be,Oe!==0&&M-Oe<Q.storage&&(_+=M-Oe),W===0&&(k=_),_+=Q.storage}let H=L.type==="int"?Int32Array:L.type==="uint"?Uint32Array:Float32Array;L.__data=new H((_-k)/Float32Array.BYTES_PER_ELEMENT),L.__offset=k}}let A=_%M;return A>0&&(_+=M-A),x.__size=_,x.__cache={},this}function v(x,b){let _={boundary:0,storage:0};return typeof x=="number"||typeof x=="boolean"?(_.boundary=4,_.storage=4):x.isVector2?(_.boundary=8,_.storage=8):x.isVector3||x.isColor?(_.boundary=16,_.storage=12):x.isVector4?(_.boundary=16,_.storage=16):x.isMatrix3?(_.boundary=16,_.storage=48):x.isMatrix4?(_.boundary=16,_.storage=64):x.isTexture?Re("WebGLRenderer: Texture samplers can not be part of an uniforms group."):ArrayBuffer.isView(x)?(_.boundary=16,_.storage=x.byteLength):Re("WebGLRenderer: Unsupported uniform value type.",x),b===!0&&(_.boundary=16,_.storage=Math.ceil(_.storage/16)*16),_}function m(x){let b=x.target;b.removeEventListener("dispose",m),i.deleteBuffer(s[b.id]),delete s[b.id],delete r[b.id]}function g(){for(let x in s)i.deleteBuffer(s[x]);s={},r={}}return{bind:o,update:a,dispose:g}}var TS=new Uint16Array([12469,15057,12620,14925,13266,14620,13807,14376,14323,13990,14545,13625,14713,13328,14840,12882,14931,12528,14996,12233,15039,11829,15066,11525,15080,11295,15085,10976,15082,10705,15073,10495,13880,14564,13898,14542,13977,14430,14158,14124,14393,13732,14556,13410,14702,12996,14814,12596,14891,12291,14937,11834,14957,11489,14958,11194,14943,10803,14921,10506,14893,10278,14858,9960,14484,14039,14487,14025,14499,13941,14524,13740,14574,13468,14654,13106,14743,12678,14818,12344,14867,11893,14889,11509,14893,11180,14881,10751,14852,10428,14812,10128,14765,9754,14712,9466,14764,13480,14764,13475,14766,13440,14766,13347,14769,13070,14786,12713,14816,12387,14844,11957,14860,11549,14868,11215,14855,10751,14825,10403,14782,10044,14729,9651,14666,9352,14599,9029,14967,12835,14966,12831,14963,12804,14954,12723,14936,12564,14917,12347,14900,11958,14886,11569,14878,11247,14859,10765,14828,10401,14784,10011,14727,9600,14660,9289,14586,8893,14508,8533,15111,12234,15110,12234,15104,12216,15092,12156,15067,12010,15028,11776,14981,11500,14942,11205,14902,10752,14861,10393,14812,9991,14752,9570,14682,9252,14603,8808,14519,8445,14431,8145,15209,11449,15208,11451,15202,11451,15190,11438,15163,11384,15117,11274,15055,10979,14994,10648,14932,10343,14871,9936,14803,9532,14729,9218,14645,8742,14556,8381,14461,8020,14365,7603,15273,10603,15272,10607,15267,10619,15256,10631,15231,10614,15182,10535,15118,10389,15042,10167,14963,9787,14883,9447,14800,9115,14710,8665,14615,8318,14514,7911,14411,7507,14279,7198,15314,9675,15313,9683,15309,9712,15298,9759,15277,9797,15229,9773,15166,9668,15084,9487,14995,9274,14898,8910,14800,8539,14697,8234,14590,7790,14479,7409,14367,7067,14178,6621,15337,8619,15337,8631,15333,8677,15325,8769,15305,8871,15264,8940,15202,8909,15119,8775,15022,8565,14916,8328,14804,8009,14688,7614,14569,7287,14448,6888,14321,6483,14088,6171,15350,7402,15350,7419,15347,7480,15340,7613,15322,7804,15287,7973,15229,8057,15148,8012,15046,7846,14933,7611,14810,7357,14682,7069,14552,6656,14421,6316,14251,5948,14007,5528,15356,5942,15356,5977,15353,6119,15348,6294,15332,6551,15302,6824,15249,7044,15171,7122,15070,7050,14949,6861,14818,6611,14679,6349,14538,6067,14398,5651,14189,5311,13935,4958,15359,4123,15359,4153,15356,4296,15353,4646,15338,5160,15311,5508,15263,5829,15188,6042,15088,6094,14966,6001,14826,5796,14678,5543,14527,5287,14377,4985,14133,4586,13869,4257,15360,1563,15360,1642,15358,2076,15354,2636,15341,3350,15317,4019,15273,4429,15203,4732,15105,4911,14981,4932,14836,4818,14679,4621,14517,4386,14359,4156,14083,3795,13808,3437,15360,122,15360,137,15358,285,15355,636,15344,1274,15322,2177,15281,2765,15215,3223,15120,3451,14995,3569,14846,3567,14681,3466,14511,3305,14344,3121,14037,2800,13753,2467,15360,0,15360,1,15359,21,15355,89,15346,253,15325,479,15287,796,15225,1148,15133,1492,15008,1749,14856,1882,14685,1886,14506,1783,14324,1608,13996,1398,13702,1183]),ui=null;function AS(){return ui===null&&(ui=new wi(TS,16,16,Xi,Qn),ui.name="DFG_LUT",ui.minFilter=pn,ui.magFilter=pn,ui.wrapS=ai,ui.wrapT=ai,ui.generateMipmaps=!1,ui.needsUpdate=!0),ui}var tc=class{constructor(e={}){let{canvas:t=Xp(),context:n=null,depth:s=!0,stencil:r=!1,alpha:o=!1,antialias:a=!1,premultipliedAlpha:l=!0,preserveDrawingBuffer:c=!1,powerPreference:h="default",failIfMajorPerformanceCaveat:u=!1,reversedDepthBuffer:d=!1,outputBufferType:f=vn}=e;this.isWebGLRenderer=!0;let p;if(n!==null){if(typeof WebGLRenderingContext<"u"&&n instanceof WebGLRenderingContext)throw new Error("THREE.WebGLRenderer: WebGL 1 is not supported since r163.");p=n.getContextAttributes().alpha}else p=o;let v=f,m=new Set([vl,_l,Mo]),g=new Set([vn,Wn,or,ms,yl,xl]),x=new Uint32Array(4),b=new Int32Array(4),_={textures:[],min:[],max:[],resolution:[]},M=null,A=null,y=[],S=[],N=null;this.domElement=t,this.debug={checkShaderErrors:!0,diagnostics:{keywords:!1},onShaderError:null},this.autoClear=!0,this.autoClearColor=!0,this.autoClearDepth=!0,this.autoClearStencil=!0,this.sortObjects=!0,this.clippingPlanes=[],this.localClippingEnabled=!1,this.toneMapping=hi,this.toneMappingExposure=1,this.transmissionResolutionScale=1;let E=this,R=!1,L=null,O=null,I=null,k=null;this._outputColorSpace=dn;let H=0,W=0,te=null,q=-1,Q=null,ee=new Ct,be=new Ct,Oe=null,Z=new De(0),he=0,ve=t.width,Ce=t.height,pe=1,Fe=null,Rt=null,Pe=new Ct(0,0,ve,Ce),nt=new Ct(0,0,ve,Ce),pt=!1,je=new Vi,qt=new so,Ot=!1,Mn=!1,Tt=new Le,si=new C,zt=new Ct,Fn={background:null,fog:null,environment:null,overrideMaterial:null,isScene:!0},Bn=!1;function kn(){return te===null?pe:1}let B=n;function zn(T,F){return t.getContext(T,F)}let bt,Mt,fe,Ut,Ie,Be,P,w,V,ne,K,re,ue,Y,j,ae,D,J,$,le,se,oe,Ae;try{let T={alpha:!0,depth:s,stencil:r,antialias:a,premultipliedAlpha:l,preserveDrawingBuffer:c,powerPreference:h,failIfMajorPerformanceCaveat:u};if("setAttribute"in t&&t.setAttribute("data-engine",`three.js r${"187"}`),t.addEventListener("webglcontextlost",Ee,!1),t.addEventListener("webglcontextrestored",Ge,!1),t.addEventListener("webglcontextcreationerror",me,!1),B===null){let F="webgl2";if(B=zn(F,T),B===null)throw zn(F)?new Error("THREE.WebGLRenderer: Error creating WebGL context with your selected attributes."):new Error("THREE.WebGLRenderer: Error creating WebGL context.")}He()}catch(T){throw t.removeEventListener("webglcontextlost",Ee,!1),t.removeEventListener("webglcontextrestored",Ge,!1),t.removeEventListener("webglcontextcreationerror",me,!1),Ne("WebGLRenderer: "+T.message),T}function He(){bt=new Fb(B),bt.init(),se=new _S(B,bt),Mt=new Ab(B,bt,e,se),fe=new yS(B,bt),Mt.reversedDepthBuffer&&d&&fe.buffers.depth.setReversed(!0),O=B.createFramebuffer(),I=B.createFramebuffer(),k=B.createFramebuffer(),Ut=new zb(B),Ie=new iS,Be=new xS(B,bt,fe,Ie,Mt,se,Ut),P=new Ub(E),w=new Gx(B),oe=new wb(B,w),V=new Bb(B,w,Ut,oe),ne=new Gb(B,V,w,oe,Ut),J=new Vb(B,Mt,Be),j=new Eb(Ie),K=new nS(E,P,bt,Mt,oe,j),re=new SS(E,Ie),ue=new rS,Y=new uS(bt),D=new Sb(E,P,fe,ne,p,l),ae=new gS(E,ne,Mt),Ae=new wS(B,Ut,Mt,fe),$=new Tb(B,bt,Ut),le=new kb(B,bt,Ut),Ut.programs=K.programs,E.capabilities=Mt,E.extensions=bt,E.properties=Ie,E.renderLists=ue,E.shadowMap=ae,E.state=fe,E.info=Ut}v!==vn&&(N=new Wb(v,t.width,t.height,a,s,r));let ie=new cd(E,B);this.xr=ie,this.getContext=function(){return B},this.getContextAttributes=function(){return B.getContextAttributes()},this.forceContextLoss=function(){let T=bt.get("WEBGL_lose_context");T&&T.loseContext()},this.forceContextRestore=function(){let T=bt.get("WEBGL_lose_context");T&&T.restoreContext()},this.getPixelRatio=function(){return pe},this.setPixelRatio=function(T){T!==void 0&&(pe=T,this.setSize(ve,Ce,!1))},this.getSize=function(T){return T.set(ve,Ce)},this.setSize=function(T,F,X=!0){if(ie.isPresenting){Re("WebGLRenderer: Can't change size while VR device is presenting.");return}ve=T,Ce=F,t.width=Math.floor(T*pe),t.height=Math.floor(F*pe),X===!0&&(t.style.width=T+"px",t.style.height=F+"px"),N!==null&&N.setSize(t.width,t.height),this.setViewport(0,0,T,F)},this.getDrawingBufferSize=function(T){return T.set(ve*pe,Ce*pe).floor()},this.setDrawingBufferSize=function(T,F,X){ve=T,Ce=F,pe=X,t.width=Math.floor(T*X),t.height=Math.floor(F*X),this.setViewport(0,0,T,F)},this.setEffects=function(T){if(v===vn){Ne("WebGLRenderer: setEffects() requires outputBufferType set to HalfFloatType or FloatType.");return}if(T){for(let F=0;F<T.length;F++)if(T[F].isOutputPass===!0){Re("WebGLRenderer: OutputPass is not needed in setEffects(). Tone mapping and color space conversion are applied automatically.");break}}N.setEffects(T||[])},this.getCurrentViewport=function(T){return T.copy(ee)},this.getViewport=function(T){return T.copy(Pe)},this.setViewport=function(T,F,X,z){T.isVector4?Pe.set(T.x,T.y,T.z,T.w):Pe.set(T,F,X,z),fe.viewport(ee.copy(Pe).multiplyScalar(kn()).round())},this.getScissor=function(T){return T.copy(nt)},this.setScissor=function(T,F,X,z){T.isVector4?nt.set(T.x,T.y,T.z,T.w):nt.set(T,F,X,z),fe.scissor(be.copy(nt).multiplyScalar(kn()).round())},this.getScissorTest=function(){return pt},this.setScissorTest=function(T){fe.setScissorTest(pt=T)},this.setOpaqueSort=function(T){Fe=T},this.setTransparentSort=function(T){Rt=T},this.getClearColor=function(T){return T.copy(D.getClearColor())},this.setClearColor=function(){D.setClearColor(...arguments)},this.getClearAlpha=function(){return D.getClearAlpha()},this.setClearAlpha=function(){D.setClearAlpha(...arguments)},this.clear=function(T=!0,F=!0,X=!0){let z=0;if(T){let G=!1;if(te!==null){let de=te.texture.format;G=m.has(de)}if(G){let de=te.texture.type,Me=g.has(de),ce=D.getClearColor(),xe=D.getClearAlpha(),Te=ce.r,ke=ce.g,Ze=ce.b;Me?(x[0]=Te,x[1]=ke,x[2]=Ze,x[3]=xe,B.clearBufferuiv(B.COLOR,0,x)):(b[0]=Te,b[1]=ke,b[2]=Ze,b[3]=xe,B.clearBufferiv(B.COLOR,0,b))}else z|=B.COLOR_BUFFER_BIT}F&&(z|=B.DEPTH_BUFFER_BIT,this.state.buffers.depth.setMask(!0)),X&&(z|=B.STENCIL_BUFFER_BIT,this.state.buffers.stencil.setMask(4294967295)),z!==0&&B.clear(z)},this.clearColor=function(){this.clear(!0,!1,!1)},this.clearDepth=function(){this.clear(!1,!0,!1)},this.clearStencil=function(){this.clear(!1,!1,!0)},this.setNodesHandler=function(T){T.setRenderer(this),L=T},this.dispose=function(){t.removeEventListener("webglcontextlost",Ee,!1),t.removeEventListener("webglcontextrestored",Ge,!1),t.removeEventListener("webglcontextcreationerror",me,!1),D.dispose(),ue.dispose(),Y.dispose(),Be.dispose(),Ie.dispose(),P.dispose(),ne.dispose(),V.dispose(),oe.dispose(),Ae.dispose(),K.dispose(),ie.dispose(),ie.removeEventListener("sessionstart",xf),ie.removeEventListener("sessionend",_f),ns.stop()};function Ee(T){T.preventDefault(),Qr("WebGLRenderer: Context Lost."),R=!0}function Ge(){Qr("WebGLRenderer: Context Restored."),R=!1;let T=Ut.autoReset,F=ae.enabled,X=ae.autoUpdate,z=ae.needsUpdate,G=ae.type;He(),Ut.autoReset=T,ae.enabled=F,ae.autoUpdate=X,ae.needsUpdate=z,ae.type=G}function me(T){Ne("WebGLRenderer: A WebGL context could not be created. Reason: ",T.statusMessage)}function dt(T){let F=T.target;F.removeEventListener("dispose",dt),Vt(F)}function Vt(T){Li(T),Ie.remove(T)}function Li(T){let F=Ie.get(T).programs;F!==void 0&&(F.forEach(function(X){K.releaseProgram(X)}),T.isShaderMaterial&&K.releaseShaderCache(T))}this.renderBufferDirect=function(T,F,X,z,G,de){F===null&&(F=Fn);let Me=G.isMesh&&G.matrixWorld.determinantAffine()<0,ce=xy(T,F,X,z,G);fe.setMaterial(z,Me);let xe=X.index,Te=1;if(z.wireframe===!0){if(xe=V.getWireframeAttribute(X),xe===void 0)return;Te=2}let ke=X.drawRange,Ze=X.attributes.position,Se=ke.start*Te,Je=(ke.start+ke.count)*Te;de!==null&&(Se=Math.max(Se,de.start*Te),Je=Math.min(Je,(de.start+de.count)*Te)),xe!==null?(Se=Math.max(Se,0),Je=Math.min(Je,xe.count)):Ze!=null&&(Se=Math.max(Se,0),Je=Math.min(Je,Ze.count));let Lt=Je-Se;if(Lt<0||Lt===1/0)return;oe.setup(G,z,ce,X,xe);let xt,mt=$;if(xe!==null&&(xt=w.get(xe),mt=le,mt.setIndex(xt)),G.isMesh)z.wireframe===!0?(fe.setLineWidth(z.wireframeLinewidth*kn()),mt.setMode(B.LINES)):mt.setMode(B.TRIANGLES);else if(G.isLine){let Qt=z.linewidth;Qt===void 0&&(Qt=1),fe.setLineWidth(Qt*kn()),G.isLineSegments?mt.setMode(B.LINES):G.isLineLoop?mt.setMode(B.LINE_LOOP):mt.setMode(B.LINE_STRIP)}else G.isPoints?mt.setMode(B.POINTS):G.isSprite&&mt.setMode(B.TRIANGLES);if(G.isBatchedMesh)if(bt.get("WEBGL_multi_draw"))mt.renderMultiDraw(G._multiDrawStarts,G._multiDrawCounts,G._multiDrawCount);else{let Qt=G._multiDrawStarts,we=G._multiDrawCounts,hn=G._multiDrawCount,at=xe?w.get(xe).bytesPerElement:1,is=Ie.get(z).currentProgram.getUniforms();for(let en=0;en<hn;en++)is.setValue(B,"_gl_DrawID",en),mt.render(Qt[en]/at,we[en])}else if(G.isInstancedMesh)mt.renderInstances(Se,Lt,G.count);else if(X.isInstancedBufferGeometry){let Qt=X._maxInstanceCount!==void 0?X._maxInstanceCount:1/0,we=Math.min(X.instanceCount,Qt);mt.renderInstances(Se,Lt,we)}else mt.render(Se,Lt)};function yf(T,F,X,z){L!==null&&T.isNodeMaterial&&L.setObject(z,T),Ot===!0&&j.setState(T,X,!1),T.transparent===!0&&T.side===wt&&T.forceSinglePass===!1?(T.side=Zt,T.needsUpdate=!0,Or(T,F,z),T.side=Nn,T.needsUpdate=!0,Or(T,F,z),T.side=wt):Or(T,F,z)}this.compile=function(T,F,X=null){X===null&&(X=T),L!==null&&L.renderStart(T,F,X),A=Y.get(X),A.init(F),S.push(A),X.traverseVisible(function(G){G.isLight&&G.layers.test(F.layers)&&(A.pushLight(G),G.castShadow&&A.pushShadow(G))}),T!==X&&T.traverseVisible(function(G){G.isLight&&G.layers.test(F.layers)&&(A.pushLight(G),G.castShadow&&A.pushShadow(G))}),A.setupLights(),L!==null&&L.updateLights(A.state.lightsArray),Mn=this.localClippingEnabled,Ot=j.init(this.clippingPlanes,Mn),Ot===!0&&j.setGlobalState(this.clippingPlanes,F),L!==null&&ae.render(A.state.shadowsArray,X,F);let z=new Set;return T.traverse(function(G){if(!(G.isMesh||G.isPoints||G.isLine||G.isSprite))return;let de=G.material;if(de)if(Array.isArray(de))for(let Me=0;Me<de.length;Me++){let ce=de[Me];yf(ce,X,F,G),z.add(ce)}else yf(de,X,F,G),z.add(de)}),A=S.pop(),L!==null&&L.renderEnd(),z},this.compileAsync=function(T,F,X=null){let z=this.compile(T,F,X);return new Promise(G=>{function de(){if(z.forEach(function(Me){let xe=Ie.get(Me).currentProgram;(xe===void 0||xe.isReady())&&z.delete(Me)}),z.size===0){G(T);return}setTimeout(de,10)}bt.get("KHR_parallel_shader_compile")!==null?de():setTimeout(de,10)})};let Nh=null;function gy(T){Nh&&Nh(T)}function xf(){ns.stop()}function _f(){ns.start()}let ns=new Tm;ns.setAnimationLoop(gy),typeof self<"u"&&ns.setContext(self),this.setAnimationLoop=function(T){Nh=T,ie.setAnimationLoop(T),T===null?ns.stop():ns.start()},ie.addEventListener("sessionstart",xf),ie.addEventListener("sessionend",_f),this.render=function(T,F){if(F!==void 0&&F.isCamera!==!0){Ne("WebGLRenderer.render: camera is not an instance of THREE.Camera.");return}if(R===!0)return;L!==null&&L.renderStart(T,F);let X=ie.enabled===!0&&ie.isPresenting===!0,z=N!==null&&(te===null||X)&&N.begin(E,te);if(T.matrixWorldAutoUpdate===!0&&T.updateMatrixWorld(),F.parent===null&&F.matrixWorldAutoUpdate===!0&&F.updateMatrixWorld(),ie.enabled===!0&&ie.isPresenting===!0&&(N===null||N.isCompositing()===!1)&&(ie.cameraAutoUpdate===!0&&ie.updateCamera(F),F=ie.getCamera()),T.isScene===!0&&T.onBeforeRender(E,T,F,te),A=Y.get(T,S.length),A.init(F),A.state.textureUnits=Be.getTextureUnits(),S.push(A),Tt.multiplyMatrices(F.projectionMatrix,F.matrixWorldInverse),F.isArrayCamera?qt.setFromArrayCamera(F):je.setFromProjectionMatrix(Tt,Gn,F.reversedDepth),Mn=this.localClippingEnabled,Ot=j.init(this.clippingPlanes,Mn),M=ue.get(T,y.length),M.init(),y.push(M),this.info.render.frame++,ie.enabled===!0&&ie.isPresenting===!0){let Me=E.xr.getDepthSensingMesh();Me!==null&&Dh(Me,F,-1/0,E.sortObjects)}Dh(T,F,0,E.sortObjects),M.finish(),L!==null&&L.updateLights(A.state.lightsArray),E.sortObjects===!0&&M.sort(Fe,Rt),Bn=ie.enabled===!1||ie.isPresenting===!1||ie.hasDepthSensing()===!1,Bn&&D.addToRenderList(M,T),this.info.autoReset===!0&&this.info.reset(),Ot===!0&&j.beginShadows();let G=A.state.shadowsArray;if(ae.render(G,T,F),Ot===!0&&j.endShadows(),(z&&N.hasRenderPass())===!1){let Me=M.opaque,ce=M.transmissive;if(A.setupLights(),F.isArrayCamera){let xe=F.cameras;if(ce.length>0)for(let Te=0,ke=xe.length;Te<ke;Te++){let Ze=xe[Te];bf(Me,ce,T,Ze)}Bn&&D.render(T);for(let Te=0,ke=xe.length;Te<ke;Te++){let Ze=xe[Te];vf(M,T,Ze,Ze.viewport)}}else ce.length>0&&bf(Me,ce,T,F),Bn&&D.render(T),vf(M,T,F)}te!==null&&W===0&&(Be.updateMultisampleRenderTarget(te),Be.updateRenderTargetMipmap(te)),z&&N.end(E),T.isScene===!0&&T.onAfterRender(E,T,F),oe.resetDefaultState(),q=-1,Q=null,S.pop(),S.length>0?(A=S[S.length-1],Be.setTextureUnits(A.state.textureUnits),Ot===!0&&j.setGlobalState(E.clippingPlanes,A.state.camera)):A=null,y.pop(),y.length>0?M=y[y.length-1]:M=null,L!==null&&L.renderEnd()};function Dh(T,F,X,z){if(T.visible===!1)return;if(T.layers.test(F.layers)){if(T.isGroup)X=T.renderOrder;else if(T.isLOD)T.autoUpdate===!0&&T.update(F);else if(T.isLight)A.pushLight(T),T.castShadow&&A.pushShadow(T);else if(T.isSprite){let Me=F.isArrayCamera?qt:je;if(!T.frustumCulled||T.intersectsFrustum(Me)){z&&zt.setFromMatrixPosition(T.matrixWorld).applyMatrix4(Tt);let ce=ne.update(T),xe=T.material;xe.visible&&M.push(T,ce,xe,X,zt.z,null,F)}}else if(T.isMesh||T.isLine||T.isPoints){let Me=F.isArrayCamera?qt:je;if(!T.frustumCulled||T.intersectsFrustum(Me)){let ce=ne.update(T),xe=T.material;if(z&&(T.boundingSphere!==void 0?(T.boundingSphere===null&&T.computeBoundingSphere(),zt.copy(T.boundingSphere.center)):(ce.boundingSphere===null&&ce.computeBoundingSphere(),zt.copy(ce.boundingSphere.center)),zt.applyMatrix4(T.matrixWorld).applyMatrix4(Tt)),Array.isArray(xe)){let Te=ce.groups;for(let ke=0,Ze=Te.length;ke<Ze;ke++){let Se=Te[ke],Je=xe[Se.materialIndex];Je&&Je.visible&&M.push(T,ce,Je,X,zt.z,Se,F)}}else xe.visible&&M.push(T,ce,xe,X,zt.z,null,F)}}}let de=T.children;for(let Me=0,ce=de.length;Me<ce;Me++)Dh(de[Me],F,X,z)}function vf(T,F,X,z){let{opaque:G,transmissive:de,transparent:Me}=T;A.setupLightsView(X),Ot===!0&&j.setGlobalState(E.clippingPlanes,X),z&&fe.viewport(ee.copy(z)),G.length>0&&ea(G,F,X),de.length>0&&ea(de,F,X),Me.length>0&&ea(Me,F,X),fe.buffers.depth.setTest(!0),fe.buffers.depth.setMask(!0),fe.buffers.color.setMask(!0),fe.setPolygonOffset(!1)}function bf(T,F,X,z){if((X.isScene===!0?X.overrideMaterial:null)!==null)return;if(A.state.transmissionRenderTarget[z.id]===void 0){let Se=bt.has("EXT_color_buffer_half_float")||bt.has("EXT_color_buffer_float");A.state.transmissionRenderTarget[z.id]=new gn(1,1,{generateMipmaps:!0,type:Se?Qn:vn,minFilter:Ei,samples:Math.max(4,Mt.samples),stencilBuffer:r,resolveDepthBuffer:!1,resolveStencilBuffer:!1,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,colorSpace:$e.workingColorSpace})}let de=A.state.transmissionRenderTarget[z.id],Me=z.viewport||ee;de.setSize(Me.z*E.transmissionResolutionScale,Me.w*E.transmissionResolutionScale);let ce=E.getRenderTarget(),xe=E.getActiveCubeFace(),Te=E.getActiveMipmapLevel();E.setRenderTarget(de),E.getClearColor(Z),he=E.getClearAlpha(),he<1&&E.setClearColor(16777215,.5),E.clear(),Bn&&D.render(X);let ke=E.toneMapping;E.toneMapping=hi;let Ze=z.viewport;if(z.viewport!==void 0&&(z.viewport=void 0),A.setupLightsView(z),Ot===!0&&j.setGlobalState(E.clippingPlanes,z),ea(T,X,z),Be.updateMultisampleRenderTarget(de),Be.updateRenderTargetMipmap(de),bt.has("WEBGL_multisampled_render_to_texture")===!1){let Se=!1;for(let Je=0,Lt=F.length;Je<Lt;Je++){let xt=F[Je],{object:mt,geometry:Qt,material:we,group:hn}=xt;if(we.side===wt&&mt.layers.test(z.layers)){let at=we.side;we.side=Zt,we.needsUpdate=!0,Mf(mt,X,z,Qt,we,hn),we.side=at,we.needsUpdate=!0,Se=!0}}Se===!0&&(Be.updateMultisampleRenderTarget(de),Be.updateRenderTargetMipmap(de))}E.setRenderTarget(ce,xe,Te),E.setClearColor(Z,he),Ze!==void 0&&(z.viewport=Ze),E.toneMapping=ke}function ea(T,F,X){let z=F.isScene===!0?F.overrideMaterial:null;for(let G=0,de=T.length;G<de;G++){let Me=T[G],{object:ce,geometry:xe,group:Te}=Me,ke=Me.material;ke.allowOverride===!0&&z!==null&&(ke=z),ce.layers.test(X.layers)&&Mf(ce,F,X,xe,ke,Te)}}function Mf(T,F,X,z,G,de){L!==null&&G.isNodeMaterial&&L.setObject(T,G),T.onBeforeRender(E,F,X,z,G,de),T.modelViewMatrix.multiplyMatrices(X.matrixWorldInverse,T.matrixWorld),T.normalMatrix.getNormalMatrix(T.modelViewMatrix),G.onBeforeRender(E,F,X,z,T,de),G.transparent===!0&&G.side===wt&&G.forceSinglePass===!1?(G.side=Zt,G.needsUpdate=!0,E.renderBufferDirect(X,F,z,G,T,de),G.side=Nn,G.needsUpdate=!0,E.renderBufferDirect(X,F,z,G,T,de),G.side=wt):E.renderBufferDirect(X,F,z,G,T,de),T.onAfterRender(E,F,X,z,G,de)}function Sf(T){let F=0;for(let X of T)X.texture!==null&&F++;return F}function Or(T,F,X){F.isScene!==!0&&(F=Fn);let z=Ie.get(T),G=A.state.lights,de=A.state.shadowsArray,Me=G.state.version,ce=K.getParameters(T,G.state,de,F,X,A.state.lightProbeGridArray),xe=K.getProgramCacheKey(ce),Te=z.programs;z.environment=T.isMeshStandardMaterial||T.isMeshLambertMaterial||T.isMeshPhongMaterial?F.environment:null,z.fog=F.fog;let ke=T.isMeshStandardMaterial||T.isMeshLambertMaterial&&!T.envMap||T.isMeshPhongMaterial&&!T.envMap;z.envMap=P.get(T.envMap||z.environment,ke),z.envMapRotation=z.environment!==null&&T.envMap===null?F.environmentRotation:T.envMapRotation,Te===void 0&&(T.addEventListener("dispose",dt),Te=new Map,z.programs=Te,z.programVariants=new Map);let Ze=Te.get(xe);if(Ze!==void 0){if(z.currentProgram===Ze&&z.lightsStateVersion===Me)return Tf(T,ce),Ze}else ce.uniforms=K.getUniforms(T),L!==null&&T.isNodeMaterial&&L.build(T,X,ce),T.onBeforeCompile(ce,E),Ze=K.acquireProgram(ce,xe),Te.set(xe,Ze),z.uniforms=ce.uniforms;let Se=z.uniforms;return(!T.isShaderMaterial&&!T.isRawShaderMaterial||T.clipping===!0)&&(Se.clippingPlanes=j.uniform),Tf(T,ce),z.needsLights=vy(T),z.lightsStateVersion=Me,z.needsLights&&(Se.ambientLightColor.value=G.state.ambient,Se.lightProbe.value=G.state.probe,Se.sunLights.value=G.state.sun,Se.sunLightShadows.value=G.state.sunShadow,Se.directionalLights.value=G.state.directional,Se.directionalLightShadows.value=G.state.directionalShadow,Se.spotLights.value=G.state.spot,Se.spotLightShadows.value=G.state.spotShadow,Se.rectAreaLights.value=G.state.rectArea,Se.ltc_1.value=G.state.rectAreaLTC1,Se.ltc_2.value=G.state.rectAreaLTC2,Se.pointLights.value=G.state.point,Se.pointLightShadows.value=G.state.pointShadow,Se.hemisphereLights.value=G.state.hemi,Se.sunShadowMatrix.value=G.state.sunShadowMatrix,Se.sunShadowCascade.value=G.state.sunShadowCascade,Se.directionalShadowMatrix.value=G.state.directionalShadowMatrix,Se.spotLightMatrix.value=G.state.spotLightMatrix,Se.spotLightMap.value=G.state.spotLightMap,Se.pointShadowMatrix.value=G.state.pointShadowMatrix),z.numLightProbeGrids=Sf(A.state.lightProbeGridArray),z.currentProgram=Ze,z.uniformsList=null,Ze}function yy(T,F,X,z,G){let de=Ie.get(T),Me=de.currentProgram.id+","+z+","+G,ce=de.programVariants.get(Me);return ce===void 0?(ce=Or(T,F,X),de.programVariants.set(Me,ce)):(de.currentProgram=ce,de.uniformsList=null,de.outputColorSpace=z,de.toneMapping=G),ce}function wf(T){if(T.uniformsList===null){let F=T.currentProgram.getUniforms();T.uniformsList=ar.seqWithValue(F.seq,T.uniforms)}return T.uniformsList}function Tf(T,F){let X=Ie.get(T);X.outputColorSpace=F.outputColorSpace,X.batching=F.batching,X.batchingColor=F.batchingColor,X.instancing=F.instancing,X.instancingColor=F.instancingColor,X.instancingMorph=F.instancingMorph,X.skinning=F.skinning,X.morphTargets=F.morphTargets,X.morphNormals=F.morphNormals,X.morphColors=F.morphColors,X.morphTargetsCount=F.morphTargetsCount,X.numClippingPlanes=F.numClippingPlanes,X.numIntersection=F.numClipIntersection,X.vertexAlphas=F.vertexAlphas,X.vertexTangents=F.vertexTangents,X.toneMapping=F.toneMapping}function xy(T,F,X,z,G){F.isScene!==!0&&(F=Fn),Be.resetTextureUnits();let de=F.fog,Me=z.isMeshStandardMaterial||z.isMeshLambertMaterial||z.isMeshPhongMaterial?F.environment:null,ce=te===null?E.outputColorSpace:te.isXRRenderTarget===!0?te.texture.colorSpace:$e.workingColorSpace,xe=z.isMeshStandardMaterial||z.isMeshLambertMaterial&&!z.envMap||z.isMeshPhongMaterial&&!z.envMap,Te=P.get(z.envMap||Me,xe),ke=z.vertexColors===!0&&!!X.attributes.color&&X.attributes.color.itemSize===4,Ze=!!X.attributes.tangent&&(!!z.normalMap||z.anisotropy>0),Se=!!X.morphAttributes.position,Je=!!X.morphAttributes.normal,Lt=!!X.morphAttributes.color,xt=hi;z.toneMapped&&(te===null||te.isXRRenderTarget===!0)&&(xt=E.toneMapping);let mt=X.morphAttributes.position||X.morphAttributes.normal||X.morphAttributes.color,Qt=mt!==void 0?mt.length:0,we=Ie.get(z),hn=A.state.lights;if(Ot===!0&&(Mn===!0||T!==Q)){let At=T===Q&&z.id===q;j.setState(z,T,At)}let at=!1,is=!1;z.version===we.__version?we.needsLights&&we.lightsStateVersion!==hn.state.version||G.isBatchedMesh&&we.batching===!1||!G.isBatchedMesh&&we.batching===!0||G.isBatchedMesh&&we.batchingColor===!0&&G._colorsTexture===null||G.isBatchedMesh&&we.batchingColor===!1&&G._colorsTexture!==null||G.isInstancedMesh&&we.instancing===!1||!G.isInstancedMesh&&we.instancing===!0||G.isSkinnedMesh&&we.skinning===!1||!G.isSkinnedMesh&&we.skinning===!0||G.isInstancedMesh&&we.instancingColor===!0&&G.instanceColor===null||G.isInstancedMesh&&we.instancingColor===!1&&G.instanceColor!==null||G.isInstancedMesh&&we.instancingMorph===!0&&G.morphTexture===null||G.isInstancedMesh&&we.instancingMorph===!1&&G.morphTexture!==null||we.envMap!==Te||z.fog===!0&&we.fog!==de||we.numClippingPlanes!==void 0&&(we.numClippingPlanes!==j.numPlanes||we.numIntersection!==j.numIntersection)||we.vertexAlphas!==ke||we.vertexTangents!==Ze||we.morphTargets!==Se||we.morphNormals!==Je||we.morphColors!==Lt||we.morphTargetsCount!==Qt||we.numLightProbeGrids!==Sf(A.state.lightProbeGridArray)?at=!0:(we.outputColorSpace!==ce||we.toneMapping!==xt)&&(is=!0):(at=!0,we.__version=z.version);let en=we.currentProgram;(at===!0||is===!0)&&(en=is===!0?yy(z,F,G,ce,xt):Or(z,F,G),L&&z.isNodeMaterial&&L.onUpdateProgram(z,en,we));let ta=!1,Ni=!1,ss=!1,it=en.getUniforms(),$t=we.uniforms;if(fe.useProgram(en.program)&&(ta=!0,Ni=!0,ss=!0),z.id!==q&&(q=z.id,Ni=!0),ta||Q!==T){fe.buffers.depth.getReversed()&&T.reversedDepth!==!0&&(T._reversedDepth=!0,T.updateProjectionMatrix()),it.setValue(B,"projectionMatrix",T.projectionMatrix),it.setValue(B,"viewMatrix",T.matrixWorldInverse);let Gt=it.map.cameraPosition;Gt!==void 0&&Gt.setValue(B,si.setFromMatrixPosition(T.matrixWorld)),Mt.logarithmicDepthBuffer&&it.setValue(B,"logDepthBufFC",2/(Math.log(T.far+1)/Math.LN2)),(z.isMeshPhongMaterial||z.isMeshToonMaterial||z.isMeshLambertMaterial||z.isMeshBasicMaterial||z.isMeshStandardMaterial||z.isShaderMaterial)&&it.setValue(B,"isOrthographic",T.isOrthographicCamera===!0),Q!==T&&(Q=T,Ni=!0,ss=!0)}if(we.needsLights&&(hn.state.sunShadowMap.length>0&&it.setValue(B,"sunShadowMap",hn.state.sunShadowMap,Be),hn.state.directionalShadowMap.length>0&&it.setValue(B,"directionalShadowMap",hn.state.directionalShadowMap,Be),hn.state.spotShadowMap.length>0&&it.setValue(B,"spotShadowMap",hn.state.spotShadowMap,Be),hn.state.pointShadowMap.length>0&&it.setValue(B,"pointShadowMap",hn.state.pointShadowMap,Be)),G.isSkinnedMesh){it.setOptional(B,G,"bindMatrix"),it.setOptional(B,G,"bindMatrixInverse");let At=G.skeleton;At&&(At.boneTexture===null&&At.computeBoneTexture(),it.setValue(B,"boneTexture",At.boneTexture,Be))}G.isBatchedMesh&&(it.setOptional(B,G,"batchingTexture"),it.setValue(B,"batchingTexture",G._matricesTexture,Be),it.setOptional(B,G,"batchingIdTexture"),it.setValue(B,"batchingIdTexture",G._indirectTexture,Be),it.setOptional(B,G,"batchingColorTexture"),G._colorsTexture!==null&&it.setValue(B,"batchingColorTexture",G._colorsTexture,Be));let Yn=X.morphAttributes;if((Yn.position!==void 0||Yn.normal!==void 0||Yn.color!==void 0)&&J.update(G,X,en),(Ni||we.receiveShadow!==G.receiveShadow)&&(we.receiveShadow=G.receiveShadow,it.setValue(B,"receiveShadow",G.receiveShadow)),(z.isMeshStandardMaterial||z.isMeshLambertMaterial||z.isMeshPhongMaterial)&&z.envMap===null&&F.environment!==null&&($t.envMapIntensity.value=F.environmentIntensity),$t.dfgLUT!==void 0&&($t.dfgLUT.value=AS()),Ni){if(it.setValue(B,"toneMappingExposure",E.toneMappingExposure),we.needsLights&&_y($t,ss),de&&z.fog===!0&&re.refreshFogUniforms($t,de),re.refreshMaterialUniforms($t,z,pe,Ce,A.state.transmissionRenderTarget[T.id]),we.needsLights&&we.numLightProbeGrids>0){let At=_,Gt=0;for(let yi of A.state.lightProbeGridArray)yi.texture!==null&&(At.textures[Gt]=yi.texture,At.min[Gt]=yi.boundingBox.min,At.max[Gt]=yi.boundingBox.max,At.resolution[Gt]=yi.resolution,Gt++);for(let yi in At)At[yi].length=Gt;$t.probesSH.value=At.textures,$t.probesMin.value=At.min,$t.probesMax.value=At.max,$t.probesResolution.value=At.resolution}ar.upload(B,wf(we),$t,Be)}if(z.isShaderMaterial&&z.uniformsNeedUpdate===!0&&(ar.upload(B,wf(we),$t,Be),z.uniformsNeedUpdate=!1),z.isSpriteMaterial&&it.setValue(B,"center",G.center),it.setValue(B,"modelViewMatrix",G.modelViewMatrix),it.setValue(B,"normalMatrix",G.normalMatrix),it.setValue(B,"modelMatrix",G.matrixWorld),z.uniformsGroups!==void 0){let At=z.uniformsGroups;for(let Gt=0,yi=At.length;Gt<yi;Gt++){let Ef=At[Gt];Ae.update(Ef,en),Ae.bind(Ef,en)}}return en}function _y(T,F){T.ambientLightColor.needsUpdate=F,T.lightProbe.needsUpdate=F,T.sunLights.needsUpdate=F,T.sunLightShadows.needsUpdate=F,T.directionalLights.needsUpdate=F,T.directionalLightShadows.needsUpdate=F,T.pointLights.needsUpdate=F,T.pointLightShadows.needsUpdate=F,T.spotLights.needsUpdate=F,T.spotLightShadows.needsUpdate=F,T.rectAreaLights.needsUpdate=F,T.hemisphereLights.needsUpdate=F}function vy(T){return T.isMeshLambertMaterial||T.isMeshToonMaterial||T.isMeshPhongMaterial||T.isMeshStandardMaterial||T.isShadowMaterial||T.isShaderMaterial&&T.lights===!0}this.getActiveCubeFace=function(){return H},this.getActiveMipmapLevel=function(){return W},this.getRenderTarget=function(){return te},this.setRenderTargetTextures=function(T,F,X){let z=Ie.get(T);z.__autoAllocateDepthBuffer=T.resolveDepthBuffer===!1,z.__autoAllocateDepthBuffer===!1&&(z.__useRenderToTexture=!1),Ie.get(T.texture).__webglTexture=F,Ie.get(T.depthTexture).__webglTexture=z.__autoAllocateDepthBuffer?void 0:X,z.__hasExternalTextures=!0},this.setRenderTargetFramebuffer=function(T,F){let X=Ie.get(T);X.__webglFramebuffer=F,X.__useDefaultFramebuffer=F===void 0},this.setRenderTarget=function(T,F=0,X=0){te=T,H=F,W=X;let z=null,G=!1,de=!1;if(T){let ce=Ie.get(T);if(ce.__useDefaultFramebuffer!==void 0){fe.bindFramebuffer(B.FRAMEBUFFER,ce.__webglFramebuffer),ee.copy(T.viewport),be.copy(T.scissor),Oe=T.scissorTest,fe.viewport(ee),fe.scissor(be),fe.setScissorTest(Oe),q=-1;return}else if(ce.__webglFramebuffer===void 0)Be.setupRenderTarget(T);else if(ce.__hasExternalTextures)Be.rebindTextures(T,Ie.get(T.texture).__webglTexture,Ie.get(T.depthTexture).__webglTexture);else if(T.depthBuffer){let ke=T.depthTexture;if(ce.__boundDepthTexture!==ke){if(ke!==null&&Ie.has(ke)&&(T.width!==ke.image.width||T.height!==ke.image.height))throw new Error("THREE.WebGLRenderer: Attached DepthTexture is initialized to the incorrect size.");Be.setupDepthRenderbuffer(T)}}let xe=T.texture;(xe.isData3DTexture||xe.isDataArrayTexture||xe.isCompressedArrayTexture)&&(de=!0);let Te=Ie.get(T).__webglFramebuffer;T.isWebGLCubeRenderTarget?(Array.isArray(Te[F])?z=Te[F][X]:z=Te[F],G=!0):T.samples>0&&Be.useMultisampledRTT(T)===!1?z=Ie.get(T).__webglMultisampledFramebuffer:Array.isArray(Te)?z=Te[X]:z=Te,ee.copy(T.viewport),be.copy(T.scissor),Oe=T.scissorTest}else ee.copy(Pe).multiplyScalar(pe).floor(),be.copy(nt).multiplyScalar(pe).floor(),Oe=pt;if(X!==0&&(z=O),fe.bindFramebuffer(B.FRAMEBUFFER,z)&&fe.drawBuffers(T,z),fe.viewport(ee),fe.scissor(be),fe.setScissorTest(Oe),G){let ce=Ie.get(T.texture);B.framebufferTexture2D(B.FRAMEBUFFER,B.COLOR_ATTACHMENT0,B.TEXTURE_CUBE_MAP_POSITIVE_X+F,ce.__webglTexture,X)}else if(de){let ce=F;for(let xe=0;xe<T.textures.length;xe++){let Te=Ie.get(T.textures[xe]);B.framebufferTextureLayer(B.FRAMEBUFFER,B.COLOR_ATTACHMENT0+xe,Te.__webglTexture,X,ce)}}else if(T!==null&&X!==0){let ce=Ie.get(T.texture);B.framebufferTexture2D(B.FRAMEBUFFER,B.COLOR_ATTACHMENT0,B.TEXTURE_2D,ce.__webglTexture,X)}q=-1};function Af(T){let F=Ie.get(T);return(F.__readFormat!==T.format||F.__readType!==T.type)&&(F.__readFormat=T.format,F.__readType=T.type,F.__formatReadable=Mt.textureFormatReadable(T.format),F.__typeReadable=Mt.textureTypeReadable(T.type)),F}this.readRenderTargetPixels=function(T,F,X,z,G,de,Me,ce=0){if(!(T&&T.isWebGLRenderTarget)){Ne("WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");return}let xe=Ie.get(T).__webglFramebuffer;if(T.isWebGLCubeRenderTarget&&Me!==void 0&&(xe=xe[Me],Array.isArray(xe)&&(xe=xe[0])),xe){fe.bindFramebuffer(B.FRAMEBUFFER,xe);try{let Te=T.textures[ce],ke=Te.format,Ze=Te.type;T.textures.length>1&&B.readBuffer(B.COLOR_ATTACHMENT0+ce);let Se=Af(Te);if(Se.__formatReadable===!1){Ne("WebGLRenderer.readRenderTargetPixels: renderTarget is not in RGBA or implementation defined format.");return}if(Se.__typeReadable===!1){Ne("WebGLRenderer.readRenderTargetPixels: renderTarget is not in UnsignedByteType or implementation defined type.");return}F>=0&&F<=T.width-z&&X>=0&&X<=T.height-G&&B.readPixels(F,X,z,G,se.convert(ke),se.convert(Ze),de)}finally{let Te=te!==null?Ie.get(te).__webglFramebuffer:null;fe.bindFramebuffer(B.FRAMEBUFFER,Te)}}},this.readRenderTargetPixelsAsync=async function(T,F,X,z,G,de,Me,ce=0){if(!(T&&T.isWebGLRenderTarget))throw new Error("THREE.WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");let xe=Ie.get(T).__webglFramebuffer;if(T.isWebGLCubeRenderTarget&&Me!==void 0&&(xe=xe[Me],Array.isArray(xe)&&(xe=xe[0])),xe)if(F>=0&&F<=T.width-z&&X>=0&&X<=T.height-G){fe.bindFramebuffer(B.FRAMEBUFFER,xe);let Te=T.textures[ce],ke=Te.format,Ze=Te.type;T.textures.length>1&&B.readBuffer(B.COLOR_ATTACHMENT0+ce);let Se=Af(Te);if(Se.__formatReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in RGBA or implementation defined format.");if(Se.__typeReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in UnsignedByteType or implementation defined type.");let Je=B.createBuffer();B.bindBuffer(B.PIXEL_PACK_BUFFER,Je),B.bufferData(B.PIXEL_PACK_BUFFER,de.byteLength,B.STREAM_READ),B.readPixels(F,X,z,G,se.convert(ke),se.convert(Ze),0),B.bindBuffer(B.PIXEL_PACK_BUFFER,null);let Lt=te!==null?Ie.get(te).__webglFramebuffer:null;fe.bindFramebuffer(B.FRAMEBUFFER,Lt);let xt=B.fenceSync(B.SYNC_GPU_COMMANDS_COMPLETE,0);return B.flush(),await $p(B,xt,4),B.bindBuffer(B.PIXEL_PACK_BUFFER,Je),B.getBufferSubData(B.PIXEL_PACK_BUFFER,0,de),B.bindBuffer(B.PIXEL_PACK_BUFFER,null),B.deleteBuffer(Je),B.deleteSync(xt),de}else throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: requested read bounds are out of range.")},this.copyFramebufferToTexture=function(T,F=null,X=0){let z=Math.pow(2,-X),G=Math.floor(T.image.width*z),de=Math.floor(T.image.height*z),Me=F!==null?F.x:0,ce=F!==null?F.y:0;Be.setTexture2D(T,0),B.copyTexSubImage2D(B.TEXTURE_2D,X,0,0,Me,ce,G,de),fe.unbindTexture()},this.copyTextureToTexture=function(T,F,X=null,z=null,G=0,de=0){let Me,ce,xe,Te,ke,Ze,Se,Je,Lt,xt=T.isCompressedTexture?T.mipmaps[de]:T.image;if(X!==null)Me=X.max.x-X.min.x,ce=X.max.y-X.min.y,xe=X.isBox3?X.max.z-X.min.z:1,Te=X.min.x,ke=X.min.y,Ze=X.isBox3?X.min.z:0;else{let it=Math.pow(2,-G);Me=Math.floor(xt.width*it),ce=Math.floor(xt.height*it),T.isDataArrayTexture?xe=xt.depth:T.isData3DTexture?xe=Math.floor(xt.depth*it):xe=1,Te=0,ke=0,Ze=0}z!==null?(Se=z.x,Je=z.y,Lt=z.z):(Se=0,Je=0,Lt=0);let mt=se.convert(F.format),Qt=se.convert(F.type),we;F.isData3DTexture?(Be.setTexture3D(F,0),we=B.TEXTURE_3D):F.isDataArrayTexture||F.isCompressedArrayTexture?(Be.setTexture2DArray(F,0),we=B.TEXTURE_2D_ARRAY):(Be.setTexture2D(F,0),we=B.TEXTURE_2D),fe.activeTexture(B.TEXTURE0),fe.pixelStorei(B.UNPACK_FLIP_Y_WEBGL,F.flipY),fe.pixelStorei(B.UNPACK_PREMULTIPLY_ALPHA_WEBGL,F.premultiplyAlpha),fe.pixelStorei(B.UNPACK_ALIGNMENT,F.unpackAlignment);let hn=fe.getParameter(B.UNPACK_ROW_LENGTH),at=fe.getParameter(B.UNPACK_IMAGE_HEIGHT),is=fe.getParameter(B.UNPACK_SKIP_PIXELS),en=fe.getParameter(B.UNPACK_SKIP_ROWS),ta=fe.getParameter(B.UNPACK_SKIP_IMAGES);fe.pixelStorei(B.UNPACK_ROW_LENGTH,xt.width),fe.pixelStorei(B.UNPACK_IMAGE_HEIGHT,xt.height),fe.pixelStorei(B.UNPACK_SKIP_PIXELS,Te),fe.pixelStorei(B.UNPACK_SKIP_ROWS,ke),fe.pixelStorei(B.UNPACK_SKIP_IMAGES,Ze);let Ni=T.isDataArrayTexture||T.isData3DTexture,ss=F.isDataArrayTexture||F.isData3DTexture;if(T.isDepthTexture){let it=Ie.get(T),$t=Ie.get(F),Yn=Ie.get(it.__renderTarget),At=Ie.get($t.__renderTarget);fe.bindFramebuffer(B.READ_FRAMEBUFFER,Yn.__webglFramebuffer),fe.bindFramebuffer(B.DRAW_FRAMEBUFFER,At.__webglFramebuffer);for(let Gt=0;Gt<xe;Gt++)Ni&&(B.framebufferTextureLayer(B.READ_FRAMEBUFFER,B.COLOR_ATTACHMENT0,Ie.get(T).__webglTexture,G,Ze+Gt),B.framebufferTextureLayer(B.DRAW_FRAMEBUFFER,B.COLOR_ATTACHMENT0,Ie.get(F).__webglTexture,de,Lt+Gt)),B.blitFramebuffer(Te,ke,Te+Me,ke+ce,Se,Je,Se+Me,Je+ce,B.DEPTH_BUFFER_BIT,B.NEAREST);fe.bindFramebuffer(B.READ_FRAMEBUFFER,null),fe.bindFramebuffer(B.DRAW_FRAMEBUFFER,null)}else if(G!==0||T.isRenderTargetTexture||Ie.has(T)){let it=Ie.get(T),$t=Ie.get(F);fe.bindFramebuffer(B.READ_FRAMEBUFFER,I),fe.bindFramebuffer(B.DRAW_FRAMEBUFFER,k);for(let Yn=0;Yn<xe;Yn++)Ni?B.framebufferTextureLayer(B.READ_FRAMEBUFFER,B.COLOR_ATTACHMENT0,it.__webglTexture,G,Ze+Yn):B.framebufferTexture2D(B.READ_FRAMEBUFFER,B.COLOR_ATTACHMENT0,B.TEXTURE_2D,it.__webglTexture,G),ss?B.framebufferTextureLayer(B.DRAW_FRAMEBUFFER,B.COLOR_ATTACHMENT0,$t.__webglTexture,de,Lt+Yn):B.framebufferTexture2D(B.DRAW_FRAMEBUFFER,B.COLOR_ATTACHMENT0,B.TEXTURE_2D,$t.__webglTexture,de),G!==0?B.blitFramebuffer(Te,ke,Te+Me,ke+ce,Se,Je,Se+Me,Je+ce,B.COLOR_BUFFER_BIT,B.NEAREST):ss?B.copyTexSubImage3D(we,de,Se,Je,Lt+Yn,Te,ke,Me,ce):B.copyTexSubImage2D(we,de,Se,Je,Te,ke,Me,ce);fe.bindFramebuffer(B.READ_FRAMEBUFFER,null),fe.bindFramebuffer(B.DRAW_FRAMEBUFFER,null)}else ss?T.isDataTexture||T.isData3DTexture?B.texSubImage3D(we,de,Se,Je,Lt,Me,ce,xe,mt,Qt,xt.data):F.isCompressedArrayTexture?B.compressedTexSubImage3D(we,de,Se,Je,Lt,Me,ce,xe,mt,xt.data):B.texSubImage3D(we,de,Se,Je,Lt,Me,ce,xe,mt,Qt,xt):T.isDataTexture?B.texSubImage2D(B.TEXTURE_2D,de,Se,Je,Me,ce,mt,Qt,xt.data):T.isCompressedTexture?B.compressedTexSubImage2D(B.TEXTURE_2D,de,Se,Je,xt.width,xt.height,mt,xt.data):B.texSubImage2D(B.TEXTURE_2D,de,Se,Je,Me,ce,mt,Qt,xt);fe.pixelStorei(B.UNPACK_ROW_LENGTH,hn),fe.pixelStorei(B.UNPACK_IMAGE_HEIGHT,at),fe.pixelStorei(B.UNPACK_SKIP_PIXELS,is),fe.pixelStorei(B.UNPACK_SKIP_ROWS,en),fe.pixelStorei(B.UNPACK_SKIP_IMAGES,ta),de===0&&F.generateMipmaps===!0&&F.mipmapsAutoUpdate===!0&&B.generateMipmap(we),fe.unbindTexture()},this.initRenderTarget=function(T){Ie.get(T).__webglFramebuffer===void 0&&Be.setupRenderTarget(T)},this.initTexture=function(T){T.isCubeTexture?Be.setTextureCube(T,0):T.isData3DTexture?Be.setTexture3D(T,0):T.isDataArrayTexture||T.isCompressedArrayTexture?Be.setTexture2DArray(T,0):Be.setTexture2D(T,0),fe.unbindTexture()},this.resetState=function(){H=0,W=0,te=null,fe.reset(),oe.reset()},typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}get coordinateSystem(){return Gn}get outputColorSpace(){return this._outputColorSpace}set outputColorSpace(e){this._outputColorSpace=e;let t=this.getContext();t.drawingBufferColorSpace=$e._getDrawingBufferColorSpace(e),t.unpackColorSpace=$e._getUnpackColorSpace()}};var qe=i=>typeof i=="object"&&i!==null?i:{},ot=i=>Array.isArray(i)?i:[],Xe=i=>typeof i=="string"?i:"",ze=i=>{let e=typeof i=="string"?Number(i):i;return typeof e=="number"&&Number.isFinite(e)?e:0},Tn=i=>i.slice(i.lastIndexOf("/")+1);function wn(i){let e=qe(i);return{x:ze(e.x),y:ze(e.y),z:ze(e.z)}}function ES(i){return i==null?{x:0,y:0,z:0,w:1}:{...wn(i),w:ze(qe(i).w)}}function sc(i){let e=qe(i);return{translation_m:wn(e.translation_m),rotation:ES(e.rotation)}}var Um={THING:"thing",STUFF:"stuff"};function hr(i){let e=qe(i),t=Xe(e.name),n=e.bounding_sphere===void 0?null:qe(e.bounding_sphere),s=e.oriented_box===void 0?null:qe(e.oriented_box),r=Tn(t);return{id:r,name:t,label:Xe(e.display_name)||`object ${r}`,kind:Um[Xe(e.kind)]??"unknown",className:Xe(e.class_name)||"unknown",classId:ze(e.class_id),classConfidence:ze(e.class_confidence),instanceConfidence:ze(e.instance_confidence),pose:sc(e.map_from_submap),sphere:n&&{center:wn(n.center_m),radius_m:ze(n.radius_m)},box:s&&{pose:sc(s.pose),size_m:wn(s.size_m)},footprint_m:ot(qe(e.footprint).xy_m).map(ze),isPresent:e.presence!=="ABSENT",isLocked:e.locked===!0,isConfirmed:e.confirmed!==!1,numFrames:ze(e.num_frames_observed),lastSeen_ns:BigInt(Xe(e.last_observed_stamp_ns)||"0"),revision:ze(e.revision),etag:Xe(e.etag)}}function CS(i){let e=qe(i);return{name:Xe(e.name),kind:Um[Xe(e.kind)]??"unknown"}}function Fm(i){let e=qe(i),t=Xe(e.name),n=qe(e.box);if(e.sphere===void 0)return{name:t,box:{min_m:wn(n.min_m),max_m:wn(n.max_m)}};let s=qe(e.sphere),{x:r,y:o,z:a}=wn(s.center_m),l=ze(s.radius_m);return{name:t,box:{min_m:{x:r-l,y:o-l,z:a-l},max_m:{x:r+l,y:o+l,z:a+l}}}}function hd(i){let e=qe(i),t=Xe(e.name);return{name:t,id:Tn(t),displayName:Xe(e.display_name)||Tn(t),revision:ze(e.revision),numFrames:ze(e.num_frames),numObjects:ze(e.num_submaps),historyId:Xe(e.history_id),classes:ot(e.label_classes).map(CS)}}function Bm(i){let e=qe(i),t=Xe(e.kind),n=ot(e.steps).map(r=>Xe(qe(r).action).toLowerCase().replaceAll("_"," ")),s=[...ot(e.changed_submaps),...ot(e.created_submaps),...ot(e.removed_submaps)];return{name:Xe(e.name),revision:ze(e.revision),time:Xe(e.create_time),author:Xe(e.author),what:t==="EDIT"?[...new Set(n)].join(", "):t.toLowerCase(),objects:s.map(r=>Tn(Xe(r))),isUndone:e.undone===!0,targets:ot(e.targets).map(Xe)}}function km(i){let e=qe(qe(i).change),t=ot(e.submaps).map(n=>{let s=qe(n),r=Xe(s.kind),o=r==="REMOVED"||r==="MERGED",a=hr(s.submap);return{id:a.id,kind:o?"removed":r==="CREATED"?"created":"changed",isGeometry:!o&&(r==="CREATED"||ot(s.parts).includes("GEOMETRY")),object:o?null:a}});return{revision:ze(e.last_revision),changes:t}}var Xt=class extends Error{constructor(t,n,s){super(t);this.status=n;this.reason=s}status;reason;get isConflict(){return this.status===409}get isLost(){return this.status===0}},rc="/v1/";async function ud(i,e={}){let t;try{t=await fetch(rc+i,e)}catch(r){throw r instanceof DOMException&&r.name==="AbortError"?r:new Xt("the server does not answer",0,"UNREACHABLE")}if(t.ok)return t;let n=qe(await t.json().catch(()=>null)),s=Xe(qe(ot(n.details)[0]).reason);throw new Xt(Xe(n.message)||`the server answered ${t.status}`,t.status,s)}var Xn=async(i,e)=>qe(await(await ud(i,e)).json()),ln=(i,e)=>Xn(i,{method:"POST",body:JSON.stringify(e),headers:{"Content-Type":"application/json"}});var ur="viewer";async function zm(i,e,t){let n={submap:e.name,etag:e.etag,move:{map_from_submap:t}};return ze((await ln(`${i}:applyEdits`,{edits:[n],author:ur})).revision)}async function Vm(i,e,t){let n={submap:e.name,etag:e.etag,rename:{display_name:t}};return ze((await ln(`${i}:applyEdits`,{edits:[n],author:ur})).revision)}async function Gm(i,e){let t={submap:e.name,etag:e.etag,delete:{}};return ze((await ln(`${i}:applyEdits`,{edits:[t],author:ur})).revision)}async function ys(i,e,t=!1){let n=await ln(`${i}:applyEdits`,{edits:[e],author:ur,validate_only:t}),s=qe(ot(n.results)[0]),r=o=>ot(o).map(a=>Tn(Xe(a)));return{revision:ze(n.revision),created:r(s.created_submaps),removed:r(s.removed_submaps),numVoxels:ze(s.num_voxels)}}var Hm=(i,e,t)=>ys(i,{submap:e.name,etag:e.etag,clone:{map_from_submap:t}}),Wm=(i,e,t,n)=>ys(i,{submap:e.name,etag:e.etag,merge:{merged_submaps:[t.name]}},n),Xm=(i,e,t,n)=>ys(i,{submap:e.name,etag:e.etag,split:t.by==="parts"?{parts:{}}:{plane:{point_m:t.point_m,normal:t.normal}}},n),qm=(i,e,t)=>ys(i,{submap:e.name,etag:e.etag,relabel:{class_name:t}}),$m=(i,e,t)=>ys(i,{submap:e.name,etag:e.etag,[t?"lock":"unlock"]:{}}),Ym=(i,e,t,n)=>ys(i,n?{clear:{box:t,ignored_region_name:e}}:{ignore_region:{name:e,box:t}}),jm=(i,e)=>ys(i,{unignore_region:{name:e}});async function Zm(i){return ot((await Xn(`${i}/ignoredRegions`)).ignored_regions).map(Fm)}async function Jm(i,e){return ze((await ln(`${i}:undoEdits`,{edit:`${i}/edits/${e}`,author:ur})).revision)}async function Km(i,e){return ze((await ln(`${i}:redoEdits`,{edit:`${i}/edits/${e}`,author:ur})).revision)}async function Qm(i,e){return ot((await Xn(`${i}/edits?page_size=${e}`)).edits).map(Bm)}function eg(i,e){i.set("undoable",[...i.get("undoable"),e]),i.set("redoable",[])}function tg(i,e){i.set("undoable",i.get("undoable").filter(t=>t!==e)),i.set("redoable",[...i.get("redoable"),e])}function ng(i,e){i.set("redoable",i.get("redoable").filter(t=>t!==e)),i.set("undoable",[...i.get("undoable"),e])}function oc(i){i.set("undoable",[]),i.set("redoable",[]),i.set("history",[]),i.set("toast",null),i.set("pending",null),i.set("probe",null),i.set("draft",null),i.set("ray",null),i.set("near",null),i.set("regions",[]),i.set("regionDraft",null),i.set("pathAnswer",null)}var ac=100;function ig(i,e){let t=e.at(-1);if(!t)return i.length===0?i:null;if(!i.some(({revision:r})=>r>=t.revision))return null;let n=new Map;for(let r of[...e].reverse())for(let o of r.targets)n.set(o,r.what==="undo");let s=i.filter(({revision:r})=>r<t.revision).map(r=>({...r,isUndone:n.get(r.name)??r.isUndone}));return[...e,...s].slice(0,ac)}var dd=3;function fi(i,e){let t=i.get("history").find(o=>o.revision===e);if(!t)return`revision ${e}`;let n=t.objects.map(o=>i.get("objects").get(o)?.label??`#${o}`),s=n.length>dd?` and ${n.length-dd} more`:"",r=t.what||"edit";return n.length===0?r:`${r} of ${n.slice(0,dd).join(", ")}${s}`}var RS=4,lc=class{constructor(e){this.store=e}store;isAsked=!1;isStale=!1;async refresh(){if(this.isStale=!0,!this.isAsked){for(this.isAsked=!0;this.isStale;)this.isStale=!1,await this.ask();this.isAsked=!1}}async ask(){let e=this.store.get("map");if(!e)return;let t=this.store.get("history"),n=a=>Qm(e.name,a).catch(()=>null),s=await n(t.length>0?RS:ac),o=(s&&(t.length>0?ig(t,s):s))??(s&&await n(ac));o&&this.store.get("map")?.historyId===e.historyId&&this.store.set("history",o)}};async function cc(){return ot((await Xn("maps")).maps).map(hd)}async function sg(i){let e=await Xn(i);return hd(e.map??e)}async function rg(i){return ot((await Xn(`${i}/revisions`)).revisions).map(e=>{let t=qe(e);return{revision:ze(t.revision),time_ms:Date.parse(Xe(t.update_time))||0}})}var og=i=>i===null?"":`&read_revision=${i}`;async function hc(i){let e=[],t=0;for(let n="";;){let s=await Xn(`${i.name}/submaps?page_token=${encodeURIComponent(n)}${og(i.at)}`);t===0&&(t=ze(s.revision));for(let r of ot(s.submaps))e.push(hr(r));if(n=Xe(s.next_page_token),n==="")return{revision:t,objects:e}}}async function No(i){return hr((await Xn(i)).submap)}var ag=i=>location.origin+rc+i;async function uc(i,e,t,n){let s=e.length===1?`${i.name}/submaps/${e[0]}/mesh?format=GLB`:`${i.name}/mesh?format=GLB${e.length>0?`&instance_ids=${e.join(",")}`:""}`,r=await ud(s+og(i.at),{cache:"no-cache",...n?{signal:n}:{}}),o=r.body?.getReader();if(!o)return r.arrayBuffer();let a=[],l=0;for(;;){let{done:u,value:d}=await o.read();if(u)break;a.push(d),l+=d.length,t(d.length)}let c=new Uint8Array(l),h=0;for(let u of a)c.set(u,h),h+=u.length;return c.buffer}var lg=(i,e,t)=>`${rc}${i}:watch?start_revision=${e}&history_id=${t}`;function Do(i,e){return(i.isPresent||e.showsGone)&&!e.hiddenClasses.has(i.className)&&!e.hiddenObjects.has(i.id)}function fd(i,e){let t=`${i.label} ${i.className} #${i.id}`.toLowerCase();return e.toLowerCase().split(/\s+/).every(n=>t.includes(n))}var cg=(i,e)=>i.sphere!==null&&(i.isPresent||e);function hg(i,e){let t=0;for(let n of i)cg(n,e)&&++t;return t}function ug(i,e,t){let n=new Map;for(let r of i){if(!cg(r,t)||!fd(r,e))continue;let o=n.get(r.className);o?o.push(r):n.set(r.className,[r])}let s={thing:0,stuff:1,unknown:2};return[...n.entries()].map(([r,o])=>({className:r,kind:o[0]?.kind??"unknown",objects:o.sort((a,l)=>a.label.localeCompare(l.label,"en",{numeric:!0}))})).sort((r,o)=>s[r.kind]-s[o.kind]||r.className.localeCompare(o.className,"en"))}var PS=(i,e)=>JSON.stringify(i.pose)===JSON.stringify(e.pose),IS=(i,e)=>i.box||!e?.box||!PS(i,e)?i:{...i,box:e.box,footprint_m:e.footprint_m};function dr(i,e){let t=new Map(i);for(let n of e)n.object?t.set(n.id,IS(n.object,i.get(n.id))):t.delete(n.id);return t}var pd=(i,e)=>{let t=new Set(i);return t.delete(e)||t.add(e),t};var dc=class{constructor(e,t){this.store=e;this.log=t}store;log;turn=Promise.resolve();move(e,t,n){return this.store.set("pending",{id:e.id,pose:t}),this.run(e,`Moved ${e.label}`,async(s,r)=>{let[o,a]=await Promise.all([zm(s,r,t),n]),l=a.map(c=>this.store.get("objects").get(c)?.label??`#${c}`);return{revision:o,note:l.length>0?`: it touches ${l.join(", ")} there`:""}})}clone(e,t){return this.run(e,`Cloned ${e.label}`,async(n,s)=>this.select(await Hm(n,s,t)))}make(e){let t=this.store.get("objects").get(e.id),n=this.store.get("objects").get(e.is==="merge"&&e.other||"");if(!t||e.is==="merge"&&!n)return Promise.resolve();let s=n?`Merged ${n.label} into ${t.label}`:`Split ${t.label}`;return this.run(t,s,async(r,o)=>{let{revision:a}=await this.apply(r,o,e,!1);return this.store.set("draft",null),a})}async tryOut(e){let t=this.store.get("map"),n=this.store.get("objects").get(e.id);if(!t||!n||e.is==="merge"&&e.other===null)return null;try{let s=await this.apply(t.name,n,e,!0),r=s.created.length,o=r===1?"One new object":`${r} new objects`;return{text:e.is==="merge"?`${n.label} keeps its name and gets all of it.`:`${o} of ${s.numVoxels.toLocaleString("en")} voxels; ${n.label} keeps the rest.`,isGood:!0}}catch(s){return{text:(s instanceof Xt&&s.reason==="NOTHING_TO_SPLIT"?"There is nothing to split so":null)??(s instanceof Error?s.message:String(s)),isGood:!1}}}apply(e,t,n,s){if(n.is==="split")return Xm(e,t,n.cut,s);let r=this.store.get("objects").get(n.other??"");if(!r)throw new Error("what was to be merged is gone");return Wm(e,t,r,s)}select({revision:e,created:t}){let[n]=t,s=this.store.get("map");return n!==void 0&&s&&No(`${s.name}/submaps/${n}`).then(r=>{this.store.get("objects").has(n)||this.store.set("objects",dr(this.store.get("objects"),[{id:n,kind:"created",isGeometry:!1,object:r}])),this.store.set("selected",n)},()=>{}),e}rename(e,t){return this.run(e,`Renamed to ${t||e.className}`,(n,s)=>Vm(n,s,t))}relabel(e,t){return this.run(e,`${e.label} is a ${t} now`,async(n,s)=>(await qm(n,s,t)).revision)}lock(e,t){let n=t?`Locked ${e.label}: robots leave it as it is`:`Unlocked ${e.label}`;return this.run(e,n,async(s,r)=>(await $m(s,r,t)).revision)}ignore({name:e,box:t,clears:n}){return this.run(null,`Robots map nothing in “${e}” any more`,async s=>{let{revision:r}=await Ym(s,e,t,n);return this.store.set("regionDraft",null),r})}lift(e){return this.run(null,`Robots map in “${e}” again`,async t=>(await jm(t,e)).revision)}delete(e){return this.run(e,`Deleted ${e.label}`,(t,n)=>Gm(t,n))}undo(e=this.store.get("undoable").at(-1)){return e===void 0?this.say("Nothing of yours to undo"):this.queue(async t=>{let n=fi(this.store,e),s=await Jm(t,e);tg(this.store,e),this.store.set("toast",{text:`Undid: ${n} (${e}) · revision ${s}`,tone:"plain"})})}redo(){let e=this.store.get("redoable").at(-1);return e===void 0?this.say("Nothing to do again"):this.queue(async t=>{let n=fi(this.store,e),s=await Km(t,e);ng(this.store,e),this.store.set("toast",{text:`Did again: ${n} (${e}) · revision ${s}`,tone:"plain"})})}async say(e){this.store.set("toast",{text:e,tone:"plain"})}run(e,t,n){return this.queue(async s=>{let r=await n(s,e),{revision:o,note:a}=typeof r=="number"?{revision:r,note:""}:r;eg(this.store,o);let l=a?"collision":"plain";this.store.set("toast",{text:`${t}${a} · revision ${o}`,tone:l,undoRevision:o})},e)}queue(e,t=null){let n=this.store.get("map");return this.store.get("at")!==null?(this.store.set("pending",null),this.say("This is how it was: nothing can be changed here. N takes you back to now.")):(this.turn=this.turn.then(async()=>{if(!(!n||this.store.get("map")?.historyId!==n.historyId)){try{await e(n.name),t&&await this.read(t)}catch(s){await this.failed(s,t)}finally{t&&this.store.get("pending")?.id===t.id&&this.store.set("pending",null)}await this.log.refresh()}}),this.turn)}async read(e){let t=await No(e.name).catch(()=>null);if(!t)return;let n=this.store.get("objects").get(t.id);n&&n.revision>t.revision||this.store.set("objects",dr(this.store.get("objects"),[{id:t.id,kind:"changed",isGeometry:!1,object:t}]))}async failed(e,t){let n=e instanceof Error?e.message:String(e),s=e instanceof Xt&&e.isConflict,r=s&&t?`Somebody else has just edited ${t.label}: yours was not made. Here is theirs.`:`Not done: ${n}`;this.store.set("toast",{text:r,tone:"problem"}),s&&t&&await this.read(t)}};var LS=150,md=(i,e)=>(e===""?i[0]:i.find(t=>t.id===e))??null,gd=i=>Promise.all([sg(i),hc({name:i,at:null})]),fc=class{maps=cc();first=null;isAsked;constructor(e,t){this.isAsked=this.maps.then(n=>{let s=md(n,e);if(!s)return;let o=s.numObjects>0&&s.numObjects<=LS?uc({name:s.name,at:null},[],t):null,a=gd(s.name);for(let l of[o,a])l?.catch(()=>{});this.first={map:s,whole:a,surfaces:o}},()=>{})}take(e){let{first:t}=this;return this.first=null,t?.map.name===e?t:null}};function U(i,e={},...t){let n=document.createElement(i);e.class&&(n.className=e.class),e.title&&(n.title=e.title),e.id&&(n.id=e.id),e.role&&n.setAttribute("role",e.role),e.tabIndex!==void 0&&(n.tabIndex=e.tabIndex),e.hidden&&(n.hidden=!0);for(let s of["type","value","placeholder"]){let r=e[s];r!==void 0&&n.setAttribute(s,r)}e.disabled&&n.setAttribute("disabled","");for(let[s,r]of Object.entries(e.aria??{}))n.setAttribute(`aria-${s}`,r);for(let[s,r]of Object.entries(e.data??{}))n.dataset[s]=r;return e.onClick&&n.addEventListener("click",e.onClick),n.append(...t.filter(s=>s!==null)),n}var NS={eye:"M1 8s2.6-4.6 7-4.6S15 8 15 8s-2.6 4.6-7 4.6S1 8 1 8zm7 2.2A2.2 2.2 0 1 0 8 5.8a2.2 2.2 0 0 0 0 4.4z",hidden:"M2 2l12 12M6 4a7 7 0 0 1 2-.6c4.400 0 7 4.600 7 4.600a12 12 0 0 1-2.100 2.600M10 12a7 7 0 0 1-2 .6C3.600 12.600 1 8 1 8a12 12 0 0 1 2.700-3",undo:"M6 3L2.500 6.500 6 10M3 6.500h6a4 4 0 0 1 0 8H7",redo:"M10 3l3.500 3.500L10 10M13 6.500H7a4 4 0 0 0 0 8h2",frame:"M2 5V2h3M11 2h3v3M14 11v3h-3M5 14H2v-3",top:"M8 1v9M4.500 6.500L8 10l3.500-3.500M2 14h12",box:"M8 1.500l6 3v7l-6 3-6-3v-7zM2 4.500l6 3 6-3M8 7.500v7",lock:"M4 7V5a4 4 0 0 1 8 0v2M3 7h10v7H3z",theme:"M8 2a6 6 0 1 0 0 12zM8 2a6 6 0 0 1 0 12",help:"M6 6a2 2 0 1 1 2.700 1.900c-.500.200-.700.600-.700 1.100v.500M8 12.200v.1",probe:"M8 1v5M8 10v5M1 8h5M10 8h5",list:"M2 4h12M2 8h12M2 12h12",close:"M3.500 3.500l9 9M12.500 3.500l-9 9",walk:"M8.500 3.500a1.200 1.200 0 1 0 0-2.400 1.200 1.200 0 0 0 0 2.400zM8.500 5L7 9l2.500 2.500V15M7 9l-1 3-2.500 2.500M8.500 5L5.500 6.500V9M8.500 5l1.500 2.500 2.500 1",path:"M2.500 13.500a1.500 1.500 0 1 0 3 0 1.500 1.500 0 0 0-3 0zM5.500 13.500H11a3 3 0 0 0 0-6H6a2.500 2.500 0 0 1 0-5h4.500M9 .8l2 1.700-2 1.700",slice:"M2 5.500l6-3 6 3-6 3zM2 10.500l6 3 6-3",clock:"M8 2a6 6 0 1 0 0 12A6 6 0 0 0 8 2zM8 4.500V8l2.500 1.500",ray:"M2.500 13.500L12 4M8.500 3.500L12.500 3.500 12.500 7.500M2.500 13.500h.1",measure:"M1.500 11l9.500-9.500 3.500 3.500-9.500 9.500zM4 8.500l1.500 1.500M6.500 6l2 2M9 3.500l1.500 1.500",clip:"M4 1v11h11M1 4h11v11",region:"M2 2h12v12H2zM4 12l8-8M4 8l4-4M8 12l4-4",camera:"M2 5h2.500L6 3h4l1.500 2H14v8H2zM8 11a2.300 2.300 0 1 0 0-4.600A2.300 2.300 0 0 0 8 11z",link:"M6.500 9.500l3-3M7 4.500l1.500-1.500a3 3 0 0 1 4.500 4.500L11.500 9M9 11.500L7.500 13A3 3 0 0 1 3 8.500L4.500 7"};function Oo(i){let e="http://www.w3.org/2000/svg",t=document.createElementNS(e,"svg");t.setAttribute("viewBox","0 0 16 16"),t.setAttribute("aria-hidden","true"),t.classList.add("icon");let n=document.createElementNS(e,"path");return n.setAttribute("d",NS[i]),t.append(n),t}function ye(i,e,t,n){return U("button",{type:"button",class:e?"button":"button only-icon",title:t,aria:{label:t},onClick:n},i?Oo(i):null,e||null)}function fr(i,e,t){let n=e*Math.cos(2*Math.PI*t),s=e*Math.sin(2*Math.PI*t),r=(i+.3963377774*n+.2158037573*s)**3,o=(i-.1055613458*n-.0638541728*s)**3,a=(i-.0894841775*n-1.291485548*s)**3,l=c=>Math.min(1,Math.max(0,c));return[l(4.0767416621*r-3.3077115913*o+.2309699292*a),l(-1.2684380046*r+2.6097574011*o-.3413193965*a),l(-.0041960863*r-.7034186147*o+1.707614701*a)]}var DS=.6180339887,yd=i=>(.13+i*DS)%1;function $i(i){return i.kind==="unknown"?fr(.5,.01,.7):i.kind==="stuff"?fr(.66,.018,yd(i.classId)):fr(.72,.1,yd(i.classId))}var OS=i=>i.kind==="thing"?fr(.7,.12,yd(Number(i.id))):$i(i),xd=fr(.76,.14,.2),fg=fr(.74,.015,.7),dg=i=>{let e=Math.min(1,Math.max(0,i));return[0,1,2].map(t=>(xd[t]??0)*(1-e)+(fg[t]??0)*e)};function pg(i,e,t){if(!e.isPresent)return xd;switch(i){case"sensor":return null;case"class":return $i(e);case"object":return OS(e);case"confidence":return dg((e.classConfidence-.4)/.55);case"last seen":return dg(1-t);case"presence":return e.kind==="unknown"?xd:fg}}function pc(i){let e=t=>{let n=t<=.0031308?12.92*t:1.055*t**.4166666666666667-.055;return Math.round(255*n)};return`rgb(${i.map(e).join(" ")})`}function mg(i,e,t){let n=i.get("at")!==null;if(t.kind==="unknown")return null;let s=(i.get("map")?.classes??[]).filter(({kind:l})=>l===t.kind).map(({name:l})=>l).sort((l,c)=>l.localeCompare(c,"en")),r=s.includes(t.className)?s:[t.className,...s],o=U("select",{class:"picker",disabled:n||t.kind!=="thing",aria:{label:"Class of the object"}},...r.map(l=>U("option",{value:l},l)));o.title=t.kind==="thing"?"What it is; robots no longer change it then":"Backgrounds keep their class",o.value=t.className,o.addEventListener("change",()=>{o.blur(),e.relabel(t,o.value)});let a=ye("lock",t.isLocked?"Unlock":"Lock",t.isLocked?"Robots may change it again; can be undone":"Robots leave it as it is; can be undone",()=>{e.lock(t,!t.isLocked)});return a.setAttribute("aria-pressed",String(t.isLocked)),a.disabled=n,U("section",{class:"card class-card"},U("label",{class:"labelled"},"It is a",o),a)}var pr=Math.pow(2,-24),Uo=Symbol("SKIP_GENERATION"),mc={strategy:0,maxDepth:40,targetLeafSize:10,useSharedArrayBuffer:!1,setBoundingBox:!0,onProgress:null,indirect:!1,verbose:!0,range:null,[Uo]:!1};function gt(i,e,t){return t.min.x=e[i],t.min.y=e[i+1],t.min.z=e[i+2],t.max.x=e[i+3],t.max.y=e[i+4],t.max.z=e[i+5],t}function Fo(i){let e=-1,t=-1/0;for(let n=0;n<3;n++){let s=i[n+3]-i[n];s>t&&(t=s,e=n)}return e}function _d(i,e,t){for(let n=0;n<3;n++){let s=e[i+2*n],r=e[i+2*n+1],o=s-r,a=s+r;o<t[n]&&(t[n]=o),a>t[n+3]&&(t[n+3]=a)}}function gc(i){let e=i[3]-i[0],t=i[4]-i[1],n=i[5]-i[2];return 2*(e*t+t*n+n*e)}function et(i,e){return e[i+15]===65535}function ut(i,e){return e[i+6]}function ft(i,e){return e[i+14]}function lt(i){return i+8}function ct(i,e){let t=e[i+6];return i+t*8}function mr(i,e){return e[i+7]}function yc(i,e,t,n,s){let r=1/0,o=1/0,a=1/0,l=-1/0,c=-1/0,h=-1/0,u=1/0,d=1/0,f=1/0,p=-1/0,v=-1/0,m=-1/0,g=i.offset||0;for(let x=(e-g)*6,b=(e+t-g)*6;x<b;x+=6){let _=i[x+0],M=i[x+1],A=_-M,y=_+M;A<r&&(r=A),y>l&&(l=y),_<u&&(u=_),_>p&&(p=_);let S=i[x+2],N=i[x+3],E=S-N,R=S+N;E<o&&(o=E),R>c&&(c=R),S<d&&(d=S),S>v&&(v=S);let L=i[x+4],O=i[x+5],I=L-O,k=L+O;I<a&&(a=I),k>h&&(h=k),L<f&&(f=L),L>m&&(m=L)}n[0]=r,n[1]=o,n[2]=a,n[3]=l,n[4]=c,n[5]=h,s[0]=u,s[1]=d,s[2]=f,s[3]=p,s[4]=v,s[5]=m}var mi=8,bd=8,vd=new Int32Array(mi),pi=new Float32Array(mi*6),gr=new Float32Array(mi*6),ti=new Float32Array(6),xc=new Float32Array(6),Yi=new Int32Array(bd),yg=new Float32Array(bd*6);function BS(i,e,t,n){for(let s=0;s<3;s++){let r=e[i+2*s],o=e[i+2*s+1],a=r-o,l=r+o;a<t[n+s]&&(t[n+s]=a),l>t[n+s+3]&&(t[n+s+3]=l)}}function xg(i,e){let t=i[e+3]-i[e],n=i[e+4]-i[e+1],s=i[e+5]-i[e+2];return 2*(t*n+n*s+s*t)}function _g(i,e,t,n,s,r){let o=-1,a=0;if(r===0)o=Fo(e),o!==-1&&(a=(e[o]+e[o+3])/2);else if(r===1)o=Fo(i),o!==-1&&(a=kS(t,n,s,o));else if(r===2){let l=gc(i),c=1.25*s,h=t.offset||0,u=(n-h)*6,d=(n+s-h)*6;for(let f=0;f<3;f++){let p=e[f],g=(e[f+3]-p)/mi;if(s<bd){for(let x=0;x<s;x++){let b=u+x*6,_=t[b+2*f],M=x;for(;M>0&&t[Yi[M-1]+2*f]>_;)Yi[M]=Yi[M-1],M--;Yi[M]=b}for(let x=0;x<3;x++)ti[x]=1/0,ti[x+3]=-1/0,xc[x]=1/0,xc[x+3]=-1/0;for(let x=s-1;x>=0;x--)_d(Yi[x],t,xc),yg.set(xc,x*6);for(let x=0;x<s-1;x++){_d(Yi[x],t,ti);let b=t[Yi[x+1]+2*f];if(t[Yi[x]+2*f]===b)continue;let _=x+1,M=s-_,A=gc(ti)/l,y=xg(yg,_*6)/l,S=1+1.25*(A*_+y*M);S<c&&(o=f,c=S,a=b)}}else{for(let _=0;_<mi;_++){vd[_]=0;for(let M=0;M<3;M++)pi[_*6+M]=1/0,pi[_*6+M+3]=-1/0}for(let _=u;_<d;_+=6){let y=~~((t[_+2*f]-p)/g);y>=mi&&(y=mi-1),vd[y]++,BS(_,t,pi,y*6)}let x=(mi-1)*6;for(let _=0;_<6;_++)gr[x+_]=pi[x+_];for(let _=mi-2;_>=0;_--){let M=_*6,A=M+6;for(let y=0;y<3;y++)gr[M+y]=Math.min(pi[M+y],gr[A+y]),gr[M+y+3]=Math.max(pi[M+y+3],gr[A+y+3])}let b=0;for(let _=0;_<mi-1;_++){let M=_*6,A=vd[_];if(A!==0)for(let R=0;R<3;R++)b===0?(ti[R]=pi[M+R],ti[R+3]=pi[M+R+3]):(ti[R]=Math.min(ti[R],pi[M+R]),ti[R+3]=Math.max(ti[R+3],pi[M+R+3]));b+=A;let y=0,S=0;b!==0&&(y=gc(ti)/l);let N=s-b;N!==0&&(S=xg(gr,M+6)/l);let E=1+1.25*(y*b+S*N);E<c&&(o=f,c=E,a=p+g+_*g)}}}}else console.warn(`BVH: Invalid build strategy value ${r} used.`);return{axis:o,pos:a}}function kS(i,e,t,n){let s=0,r=i.offset;for(let o=e,a=e+t;o<a;o++)s+=i[(o-r)*6+n*2];return s/t}function vg(i,e,t,n,s,r){let o=n,a=n+s-1,l=r.pos,c=r.axis*2,h=t.offset||0;for(;;){for(;o<=a&&t[(o-h)*6+c]<l;)o++;for(;o<=a&&t[(a-h)*6+c]>=l;)a--;if(o<a){for(let u=0;u<e;u++){let d=i[o*e+u];i[o*e+u]=i[a*e+u],i[a*e+u]=d}for(let u=0;u<6;u++){let d=o-h,f=a-h,p=t[d*6+u];t[d*6+u]=t[f*6+u],t[f*6+u]=p}o++,a--}else return o}}var zS=Math.pow(2,32),yr=new Float32Array(6),_c=new Float32Array(6);function VS(i,e,t,n,s,r){let{maxDepth:o,verbose:a,targetLeafSize:l,_strictLeafSize:c=1/0,strategy:h,onProgress:u,useSharedArrayBuffer:d=!1}=s,f=i.primitiveBuffer,p=i.primitiveBufferStride,v=d?SharedArrayBuffer:ArrayBuffer,m=new v(32*Math.max(1,2*Math.ceil(n)-1)),g=new Float32Array(m),x=new Uint32Array(m),b=new Uint16Array(m),_=0,M=!1;return yc(e,t,n,yr,_c),S(t,n,0),m.slice(0,_*32);function A(N){u&&u((N-r.offset)/r.count)}function y(N,E,R){let L=N*2;x[N+6]=E,b[L+14]=R,b[L+15]=65535,A(E+R)}function S(N,E,R){let L=_++,O=L*8;g.set(yr,O),!M&&R>=o&&(M=!0,a&&console.warn(`BVH: Max depth of ${o} reached when generating BVH. Consider increasing maxDepth.`));let I=E>c;if(E<=l&&!I||R>=o){y(O,N,E);return}let k=_g(yr,_c,e,N,E,h),H=k.axis===-1?-1:vg(f,p,e,N,E,k);if(k.axis===-1||H===N||H===N+E){if(!I){y(O,N,E);return}k.axis=Math.max(0,Fo(yr)),H=N+Math.max(1,Math.floor(E/2))}x[O+7]=k.axis;let W=H-N;yc(e,N,W,yr,_c),S(N,W,R+1);let te=_-L;if(te>zS)throw new Error("MeshBVH: Cannot store relative child node offset greater than 32 bits.");x[O+6]=te;let q=E-W;yc(e,H,q,yr,_c),S(H,q,R+1)}}function bg(i,e){let t=i.getRootRanges(e.range),n=t[0],s=t[t.length-1],r={offset:n.offset,count:s.offset+s.count-n.offset},o=new Float32Array(6*r.count);o.offset=r.offset,i.computePrimitiveBounds(r.offset,r.count,o),i._roots=t.map(a=>VS(i,o,a.offset,a.count,e,r))}var ji=class{constructor(e){this._getNewPrimitive=e,this._primitives=[]}getPrimitive(){let e=this._primitives;return e.length===0?this._getNewPrimitive():e.pop()}releasePrimitive(e){this._primitives.push(e)}};var Md=class{constructor(){this.float32Array=null,this.uint16Array=null,this.uint32Array=null;let e=[],t=null;this.setBuffer=n=>{t&&e.push(t),t=n,this.float32Array=new Float32Array(n),this.uint16Array=new Uint16Array(n),this.uint32Array=new Uint32Array(n)},this.clearBuffer=()=>{t=null,this.float32Array=null,this.uint16Array=null,this.uint32Array=null,e.length!==0&&this.setBuffer(e.pop())}}},Ye=new Md;var Zi,_r,xr=[],vc=new ji(()=>new st);function Mg(i,e,t,n,s,r){Zi=vc.getPrimitive(),_r=vc.getPrimitive(),xr.push(Zi,_r),Ye.setBuffer(i._roots[e]);let o=Sd(0,i.geometry,t,n,s,r);Ye.clearBuffer(),vc.releasePrimitive(Zi),vc.releasePrimitive(_r),xr.pop(),xr.pop();let a=xr.length;return a>0&&(_r=xr[a-1],Zi=xr[a-2]),o}function Sd(i,e,t,n,s=null,r=0,o=0){let{float32Array:a,uint16Array:l,uint32Array:c}=Ye,h=i*2;if(et(h,l)){let d=ut(i,c),f=ft(h,l);return gt(i,a,Zi),n(d,f,!1,o,r+i/8,Zi)}else{let E=function(L){let{uint16Array:O,uint32Array:I}=Ye,k=L*2;for(;!et(k,O);)L=lt(L),k=L*2;return ut(L,I)},R=function(L){let{uint16Array:O,uint32Array:I}=Ye,k=L*2;for(;!et(k,O);)L=ct(L,I),k=L*2;return ut(L,I)+ft(k,O)},d=lt(i),f=ct(i,c),p=d,v=f,m,g,x,b;if(s&&(x=Zi,b=_r,gt(p,a,x),gt(v,a,b),m=s(x),g=s(b),g<m)){p=f,v=d;let L=m;m=g,g=L,x=b}x||(x=Zi,gt(p,a,x));let _=et(p*2,l),M=t(x,_,m,o+1,r+p/8),A;if(M===2){let L=E(p),I=R(p)-L;A=n(L,I,!0,o+1,r+p/8,x)}else A=M&&Sd(p,e,t,n,s,r,o+1);if(A)return!0;b=_r,gt(v,a,b);let y=et(v*2,l),S=t(b,y,g,o+1,r+v/8),N;if(S===2){let L=E(v),I=R(v)-L;N=n(L,I,!0,o+1,r+v/8,b)}else N=S&&Sd(v,e,t,n,s,r,o+1);return!!N}}var Bo=new Ye.constructor,bc=new Ye.constructor,Ji=new ji(()=>new st),vr=new st,br=new st,Td=new st,Ad=new st,Ed=!1;function Sg(i,e,t,n){if(Ed)throw new Error("MeshBVH: Recursive calls to bvhcast not supported.");Ed=!0;let s=i._roots,r=e._roots,o,a=0,l=0,c=new Le().copy(t).invert();for(let h=0,u=s.length;h<u;h++){Bo.setBuffer(s[h]),l=0;let d=Ji.getPrimitive();gt(0,Bo.float32Array,d),d.applyMatrix4(c);for(let f=0,p=r.length;f<p&&(bc.setBuffer(r[f]),o=ni(0,0,t,c,n,a,l,0,0,d),bc.clearBuffer(),l+=r[f].byteLength/32,!o);f++);if(Ji.releasePrimitive(d),Bo.clearBuffer(),a+=s[h].byteLength/32,o)break}return Ed=!1,o}function ni(i,e,t,n,s,r=0,o=0,a=0,l=0,c=null,h=!1){let u,d;h?(u=bc,d=Bo):(u=Bo,d=bc);let f=u.float32Array,p=u.uint32Array,v=u.uint16Array,m=d.float32Array,g=d.uint32Array,x=d.uint16Array,b=i*2,_=e*2,M=et(b,v),A=et(_,x),y=!1;if(A&&M)h?y=s(ut(e,g),ft(e*2,x),ut(i,p),ft(i*2,v),l,o+e/8,a,r+i/8):y=s(ut(i,p),ft(i*2,v),ut(e,g),ft(e*2,x),a,r+i/8,l,o+e/8);else if(A){let S=Ji.getPrimitive();gt(e,m,S),S.applyMatrix4(t);let N=lt(i),E=ct(i,p);gt(N,f,vr),gt(E,f,br);let R=S.intersectsBox(vr),L=S.intersectsBox(br);y=R&&ni(e,N,n,t,s,o,r,l,a+1,S,!h)||L&&ni(e,E,n,t,s,o,r,l,a+1,S,!h),Ji.releasePrimitive(S)}else{let S=lt(e),N=ct(e,g);gt(S,m,Td),gt(N,m,Ad);let E=c.intersectsBox(Td),R=c.intersectsBox(Ad);if(E&&R)y=ni(i,S,t,n,s,r,o,a,l+1,c,h)||ni(i,N,t,n,s,r,o,a,l+1,c,h);else if(E)if(M)y=ni(i,S,t,n,s,r,o,a,l+1,c,h);else{let L=Ji.getPrimitive();L.copy(Td).applyMatrix4(t);let O=lt(i),I=ct(i,p);gt(O,f,vr),gt(I,f,br);let k=L.intersectsBox(vr),H=L.intersectsBox(br);y=k&&ni(S,O,n,t,s,o,r,l,a+1,L,!h)||H&&ni(S,I,n,t,s,o,r,l,a+1,L,!h),Ji.releasePrimitive(L)}else if(R)if(M)y=ni(i,N,t,n,s,r,o,a,l+1,c,h);else{let L=Ji.getPrimitive();L.copy(Ad).applyMatrix4(t);let O=lt(i),I=ct(i,p);gt(O,f,vr),gt(I,f,br);let k=L.intersectsBox(vr),H=L.intersectsBox(br);y=k&&ni(N,O,n,t,s,o,r,l,a+1,L,!h)||H&&ni(N,I,n,t,s,o,r,l,a+1,L,!h),Ji.releasePrimitive(L)}}return y}var Mc=new class{constructor(){let i=null,e=null,t=null,n=!1;this.root=null,this.buffer=null,this.uint32Array=null,this.uint16Array=null,this.setBVH=(r,o)=>{if(n)throw new Error("BVHTraversalHelper: cannot call setBVH during an active traversal.");this.root=o,this.buffer=i=r._roots[o],this.uint16Array=t=new Uint16Array(i),this.uint32Array=e=new Uint32Array(i)},this.reset=()=>{this.root=null,this.buffer=i=null,this.uint16Array=t=null,this.uint32Array=e=null},this.getRangeStart=r=>{let o=r*2;for(;!et(o,t);)r=lt(r),o=r*2;return ut(r,e)},this.getRangeEnd=r=>{let o=r*2;for(;!et(o,t);)r=ct(r,e),o=r*2;return ut(r,e)+ft(o,t)};let s=(r,o,a)=>{let l=o*2,c=et(l,t);if(!r(a,c,o)&&!c){let u=lt(o),d=ct(o,e);s(r,u,a+1),s(r,d,a+1)}};this.traverseBuffer=r=>{if(n)throw new Error("BVHTraversalHelper: cannot start a traversal during an active traversal.");n=!0;try{s(r,0,0)}finally{n=!1}},this.traverse=r=>{this.traverseBuffer((o,a,l)=>{if(a){let c=l*2,h=e[l+6],u=t[c+14];return r(o,a,new Float32Array(i,l*4,6),h,u)}else{let c=mr(l,e);return r(o,a,new Float32Array(i,l*4,6),c)}})}}};var wg=new st,Mr=new Float32Array(6),Sc=class{constructor(){this._roots=null,this.primitiveBuffer=null,this.primitiveBufferStride=null}init(e){e={...mc,...e},"maxLeafSize"in e&&(console.warn('BVH: "maxLeafSize" option has been deprecated. Use "targetLeafSize", instead.'),e={...e,targetLeafSize:e.maxLeafSize}),bg(this,e)}getRootRanges(){throw new Error("BVH: getRootRanges() not implemented")}writePrimitiveBounds(){throw new Error("BVH: writePrimitiveBounds() not implemented")}writePrimitiveRangeBounds(e,t,n,s){let r=1/0,o=1/0,a=1/0,l=-1/0,c=-1/0,h=-1/0;for(let u=e,d=e+t;u<d;u++){this.writePrimitiveBounds(u,Mr,0);let[f,p,v,m,g,x]=Mr;f<r&&(r=f),m>l&&(l=m),p<o&&(o=p),g>c&&(c=g),v<a&&(a=v),x>h&&(h=x)}return n[s+0]=r,n[s+1]=o,n[s+2]=a,n[s+3]=l,n[s+4]=c,n[s+5]=h,n}computePrimitiveBounds(e,t,n){let s=n.offset||0;for(let r=e,o=e+t;r<o;r++){this.writePrimitiveBounds(r,Mr,0);let[a,l,c,h,u,d]=Mr,f=(a+h)/2,p=(l+u)/2,v=(c+d)/2,m=(h-a)/2,g=(u-l)/2,x=(d-c)/2,b=(r-s)*6;n[b+0]=f,n[b+1]=m+(Math.abs(f)+m)*pr,n[b+2]=p,n[b+3]=g+(Math.abs(p)+g)*pr,n[b+4]=v,n[b+5]=x+(Math.abs(v)+x)*pr}return n}shiftPrimitiveOffsets(e){let t=this._indirectBuffer;if(t)for(let n=0,s=t.length;n<s;n++)t[n]+=e;else{let n=this._roots;for(let s=0;s<n.length;s++){let r=n[s],o=new Uint32Array(r),a=new Uint16Array(r),l=r.byteLength/32;for(let c=0;c<l;c++){let h=8*c,u=2*h;et(u,a)&&(o[h+6]+=e)}}}}traverse(e,t=0){Mc.setBVH(this,t),Mc.traverse(e),Mc.reset()}refit(){let e=this._roots;for(let t=0,n=e.length;t<n;t++){let s=e[t],r=new Uint32Array(s),o=new Uint16Array(s),a=new Float32Array(s),l=s.byteLength/32;for(let c=l-1;c>=0;c--){let h=c*8,u=h*2;if(et(u,o)){let f=ut(h,r),p=ft(u,o);this.writePrimitiveRangeBounds(f,p,Mr,0),a.set(Mr,h)}else{let f=lt(h),p=ct(h,r);for(let v=0;v<3;v++){let m=a[f+v],g=a[f+v+3],x=a[p+v],b=a[p+v+3];a[h+v]=m<x?m:x,a[h+v+3]=g>b?g:b}}}}}getBoundingBox(e){return e.makeEmpty(),this._roots.forEach(n=>{gt(0,new Float32Array(n),wg),e.union(wg)}),e}shapecast(e){let{boundsTraverseOrder:t,intersectsBounds:n,intersectsRange:s,intersectsPrimitive:r,scratchPrimitive:o,iterate:a}=e;if(s&&r){let u=s;s=(d,f,p,v,m)=>u(d,f,p,v,m)?!0:a(d,f,this,r,p,v,o)}else s||(r?s=(u,d,f,p)=>a(u,d,this,r,f,p,o):s=(u,d,f)=>f);let l=!1,c=0,h=this._roots;for(let u=0,d=h.length;u<d;u++){let f=h[u];if(l=Mg(this,u,n,s,t,c),l)break;c+=f.byteLength/32}return l}bvhcast(e,t,n){let{intersectsRanges:s}=n;return Sg(this,e,t,s)}};function Tg(){return typeof SharedArrayBuffer<"u"}function Cd(i){return i.index?i.index.count:i.attributes.position.count}function Ki(i){return Cd(i)/3}function HS(i,e=ArrayBuffer){return i>65535?new Uint32Array(new e(4*i)):new Uint16Array(new e(2*i))}function Ag(i,e){if(!i.index){let t=i.attributes.position.count,n=e.useSharedArrayBuffer?SharedArrayBuffer:ArrayBuffer,s=HS(t,n);i.setIndex(new Qe(s,1));for(let r=0;r<t;r++)s[r]=r}}function WS(i,e,t){let n=Cd(i)/t,s=e||i.drawRange,r=s.start/t,o=(s.start+s.count)/t,a=Math.max(0,r),l=Math.min(n,o)-a;return{offset:Math.floor(a),count:Math.floor(l)}}function XS(i,e){return i.groups.map(t=>({offset:t.start/e,count:t.count/e}))}function Rd(i,e,t){let n=WS(i,e,t),s=XS(i,t);if(!s.length)return[n];let r=[],o=n.offset,a=n.offset+n.count,l=Cd(i)/t,c=[];for(let d of s){let{offset:f,count:p}=d,v=f,m=isFinite(p)?p:l-f,g=f+m;v<a&&g>o&&(c.push({pos:Math.max(o,v),isStart:!0}),c.push({pos:Math.min(a,g),isStart:!1}))}c.sort((d,f)=>d.pos!==f.pos?d.pos-f.pos:d.type==="end"?-1:1);let h=0,u=null;for(let d of c){let f=d.pos;h!==0&&f!==u&&r.push({offset:u,count:f-u}),h+=d.isStart?1:-1,u=f}return r}function qS(i,e){let t=i[i.length-1],n=t.offset+t.count>2**16,s=i.reduce((c,h)=>c+h.count,0),r=n?4:2,o=e?new SharedArrayBuffer(s*r):new ArrayBuffer(s*r),a=n?new Uint32Array(o):new Uint16Array(o),l=0;for(let c=0;c<i.length;c++){let{offset:h,count:u}=i[c];for(let d=0;d<u;d++)a[l+d]=h+d;l+=u}return a}var wc=class extends Sc{get indirect(){return!!this._indirectBuffer}get primitiveStride(){return null}get primitiveBufferStride(){return this.indirect?1:this.primitiveStride}set primitiveBufferStride(e){}get primitiveBuffer(){return this.indirect?this._indirectBuffer:this.geometry.index.array}set primitiveBuffer(e){}constructor(e,t={}){if(e.isBufferGeometry){if(e.index&&e.index.isInterleavedBufferAttribute)throw new Error("BVH: InterleavedBufferAttribute is not supported for the index attribute.")}else throw new Error("BVH: Only BufferGeometries are supported.");if(t.useSharedArrayBuffer&&!Tg())throw new Error("BVH: SharedArrayBuffer is not available.");super(),this.geometry=e,this.resolvePrimitiveIndex=t.indirect?n=>this._indirectBuffer[n]:n=>n,this.primitiveBuffer=null,this.primitiveBufferStride=null,this._indirectBuffer=null,t={...mc,...t},t[Uo]||this.init(t)}init(e){let{geometry:t,primitiveStride:n}=this;if(e.indirect){let s=Rd(t,e.range,n),r=qS(s,e.useSharedArrayBuffer);this._indirectBuffer=r}else Ag(t,e);super.init(e),!t.boundingBox&&e.setBoundingBox&&(t.boundingBox=this.getBoundingBox(new st))}getRootRanges(e){return this.indirect?[{offset:0,count:this._indirectBuffer.length}]:Rd(this.geometry,e,this.primitiveStride)}raycastObject3D(){throw new Error("BVH: raycastObject3D() not implemented")}};var On=class{constructor(){this.min=1/0,this.max=-1/0}setFromPointsField(e,t){let n=1/0,s=-1/0;for(let r=0,o=e.length;r<o;r++){let l=e[r][t];n=l<n?l:n,s=l>s?l:s}this.min=n,this.max=s}setFromPoints(e,t){let n=1/0,s=-1/0;for(let r=0,o=t.length;r<o;r++){let a=t[r],l=e.dot(a);n=l<n?l:n,s=l>s?l:s}this.min=n,this.max=s}isSeparated(e){return this.min>e.max||e.min>this.max}};On.prototype.setFromBox=(function(){let i=new C;return function(t,n){let s=n.min,r=n.max,o=1/0,a=-1/0;for(let l=0;l<=1;l++)for(let c=0;c<=1;c++)for(let h=0;h<=1;h++){i.x=s.x*l+r.x*(1-l),i.y=s.y*c+r.y*(1-c),i.z=s.z*h+r.z*(1-h);let u=t.dot(i);o=Math.min(u,o),a=Math.max(u,a)}this.min=o,this.max=a}})();var $S=(function(){let i=new C,e=new C,t=new C;return function(s,r,o){let a=s.start,l=i,c=r.start,h=e;t.subVectors(a,c),i.subVectors(s.end,s.start),e.subVectors(r.end,r.start);let u=t.dot(h),d=h.dot(l),f=h.dot(h),p=t.dot(l),m=l.dot(l)*f-d*d,g,x;m!==0?g=(u*d-p*f)/m:g=0,x=(u+g*d)/f,o.x=g,o.y=x}})(),ko=(function(){let i=new _e,e=new C,t=new C;return function(s,r,o,a){$S(s,r,i);let l=i.x,c=i.y;if(l>=0&&l<=1&&c>=0&&c<=1){s.at(l,o),r.at(c,a);return}else if(l>=0&&l<=1){c<0?r.at(0,a):r.at(1,a),s.closestPointToPoint(a,!0,o);return}else if(c>=0&&c<=1){l<0?s.at(0,o):s.at(1,o),r.closestPointToPoint(o,!0,a);return}else{let h;l<0?h=s.start:h=s.end;let u;c<0?u=r.start:u=r.end;let d=e,f=t;if(s.closestPointToPoint(u,!0,e),r.closestPointToPoint(h,!0,t),d.distanceToSquared(u)<=f.distanceToSquared(h)){o.copy(d),a.copy(u);return}else{o.copy(h),a.copy(f);return}}}})(),Eg=(function(){let i=new C,e=new C,t=new St,n=new _n;return function(r,o){let{radius:a,center:l}=r,{a:c,b:h,c:u}=o;if(n.start=c,n.end=h,n.closestPointToPoint(l,!0,i).distanceTo(l)<=a||(n.start=c,n.end=u,n.closestPointToPoint(l,!0,i).distanceTo(l)<=a)||(n.start=h,n.end=u,n.closestPointToPoint(l,!0,i).distanceTo(l)<=a))return!0;let v=o.getPlane(t);if(Math.abs(v.distanceToPoint(l))<=a){let g=v.projectPoint(l,e);if(o.containsPoint(g))return!0}return!1}})();var YS=["x","y","z"],Pi=1e-15,Cg=Pi*Pi;function qn(i){return Math.abs(i)<Pi}var Jt=class extends Yt{constructor(...e){super(...e),this.isExtendedTriangle=!0,this.satAxes=new Array(4).fill().map(()=>new C),this.satBounds=new Array(4).fill().map(()=>new On),this.points=[this.a,this.b,this.c],this.plane=new St,this.isDegenerateIntoSegment=!1,this.isDegenerateIntoPoint=!1,this.degenerateSegment=new _n,this.needsUpdate=!0}intersectsSphere(e){return Eg(e,this)}update(){let e=this.a,t=this.b,n=this.c,s=this.points,r=this.satAxes,o=this.satBounds,a=r[0],l=o[0];this.getNormal(a),l.setFromPoints(a,s);let c=r[1],h=o[1];c.subVectors(e,t),h.setFromPoints(c,s);let u=r[2],d=o[2];u.subVectors(t,n),d.setFromPoints(u,s);let f=r[3],p=o[3];f.subVectors(n,e),p.setFromPoints(f,s);let v=c.length(),m=u.length(),g=f.length();this.isDegenerateIntoPoint=!1,this.isDegenerateIntoSegment=!1,v<Pi?m<Pi||g<Pi?this.isDegenerateIntoPoint=!0:(this.isDegenerateIntoSegment=!0,this.degenerateSegment.start.copy(e),this.degenerateSegment.end.copy(n)):m<Pi?g<Pi?this.isDegenerateIntoPoint=!0:(this.isDegenerateIntoSegment=!0,this.degenerateSegment.start.copy(t),this.degenerateSegment.end.copy(e)):g<Pi&&(this.isDegenerateIntoSegment=!0,this.degenerateSegment.start.copy(n),this.degenerateSegment.end.copy(t)),this.plane.setFromNormalAndCoplanarPoint(a,e),this.needsUpdate=!1}};Jt.prototype.closestPointToSegment=(function(){let i=new C,e=new C,t=new _n;return function(s,r=null,o=null){this.needsUpdate&&this.update();let{start:a,end:l}=s,c=this.points,h,u=1/0,d=this.plane.distanceToPoint(a),f=this.plane.distanceToPoint(l);if(d*f<0&&this.plane.intersectLine(s,i)!==null&&this.containsPoint(i))return r&&r.copy(i),o&&o.copy(i),0;for(let p=0;p<3;p++){let v=(p+1)%3;t.start.copy(c[p]),t.end.copy(c[v]),ko(t,s,i,e),h=i.distanceToSquared(e),h<u&&(u=h,r&&r.copy(i),o&&o.copy(e))}return this.closestPointToPoint(a,i),h=a.distanceToSquared(i),h<u&&(u=h,r&&r.copy(i),o&&o.copy(a)),this.closestPointToPoint(l,i),h=l.distanceToSquared(i),h<u&&(u=h,r&&r.copy(i),o&&o.copy(l)),Math.sqrt(u)}})();Jt.prototype.intersectsTriangle=(function(){let i=new Jt,e=new On,t=new On,n=new C,s=new C,r=new C,o=new C,a=new _n,l=new _n,c=new C,h=new _e,u=new _e;function d(b,_,M,A){let y=n;!b.isDegenerateIntoPoint&&!b.isDegenerateIntoSegment?y.copy(b.plane.normal):y.copy(_.plane.normal);let S=b.satBounds,N=b.satAxes;for(let L=1;L<4;L++){let O=S[L],I=N[L];if(e.setFromPoints(I,_.points),O.isSeparated(e)||(o.copy(y).cross(I),e.setFromPoints(o,b.points),t.setFromPoints(o,_.points),e.isSeparated(t)))return!1}let E=_.satBounds,R=_.satAxes;for(let L=1;L<4;L++){let O=E[L],I=R[L];if(e.setFromPoints(I,b.points),O.isSeparated(e)||(o.crossVectors(y,I),e.setFromPoints(o,b.points),t.setFromPoints(o,_.points),e.isSeparated(t)))return!1}return M&&(A||console.warn("ExtendedTriangle.intersectsTriangle: Triangles are coplanar which does not support an output edge. Setting edge to 0, 0, 0."),M.start.set(0,0,0),M.end.set(0,0,0)),!0}function f(b,_,M,A,y,S,N,E,R,L,O){let I=N/(N-E);L.x=A+(y-A)*I,O.start.subVectors(_,b).multiplyScalar(I).add(b),I=N/(N-R),L.y=A+(S-A)*I,O.end.subVectors(M,b).multiplyScalar(I).add(b)}function p(b,_,M,A,y,S,N,E,R,L,O){if(y>0)f(b.c,b.a,b.b,A,_,M,R,N,E,L,O);else if(S>0)f(b.b,b.a,b.c,M,_,A,E,N,R,L,O);else if(E*R>0||N!=0)f(b.a,b.b,b.c,_,M,A,N,E,R,L,O);else if(E!=0)f(b.b,b.a,b.c,M,_,A,E,N,R,L,O);else if(R!=0)f(b.c,b.a,b.b,A,_,M,R,N,E,L,O);else return!0;return!1}function v(b,_,M,A){let y=_.degenerateSegment,S=b.plane.distanceToPoint(y.start),N=b.plane.distanceToPoint(y.end);return qn(S)?qn(N)?d(b,_,M,A):(M&&(M.start.copy(y.start),M.end.copy(y.start)),b.containsPoint(y.start)):qn(N)?(M&&(M.start.copy(y.end),M.end.copy(y.end)),b.containsPoint(y.end)):b.plane.intersectLine(y,n)!=null?(M&&(M.start.copy(n),M.end.copy(n)),b.containsPoint(n)):!1}function m(b,_,M){let A=_.a;return qn(b.plane.distanceToPoint(A))&&b.containsPoint(A)?(M&&(M.start.copy(A),M.end.copy(A)),!0):!1}function g(b,_,M){let A=b.degenerateSegment,y=_.a;return A.closestPointToPoint(y,!0,n),y.distanceToSquared(n)<Cg?(M&&(M.start.copy(y),M.end.copy(y)),!0):!1}function x(b,_,M,A){if(b.isDegenerateIntoSegment)if(_.isDegenerateIntoSegment){let y=b.degenerateSegment,S=_.degenerateSegment,N=s,E=r;y.delta(N),S.delta(E);let R=n.subVectors(S.start,y.start),L=N.x*E.y-N.y*E.x;if(qn(L))return!1;let O=(R.x*E.y-R.y*E.x)/L,I=-(N.x*R.y-N.y*R.x)/L;if(O<0||O>1||I<0||I>1)return!1;let k=y.start.z+N.z*O,H=S.start.z+E.z*I;return qn(k-H)?(M&&(M.start.copy(y.start).addScaledVector(N,O),M.end.copy(y.start).addScaledVector(N,O)),!0):!1}else return _.isDegenerateIntoPoint?g(b,_,M):v(_,b,M,A);else{if(b.isDegenerateIntoPoint)return _.isDegenerateIntoPoint?_.a.distanceToSquared(b.a)<Cg?(M&&(M.start.copy(b.a),M.end.copy(b.a)),!0):!1:_.isDegenerateIntoSegment?g(_,b,M):m(_,b,M);if(_.isDegenerateIntoPoint)return m(b,_,M);if(_.isDegenerateIntoSegment)return v(b,_,M,A)}}return function(_,M=null,A=!1){this.needsUpdate&&this.update(),_.isExtendedTriangle?_.needsUpdate&&_.update():(i.copy(_),i.update(),_=i);let y=x(this,_,M,A);if(y!==void 0)return y;let S=this.plane,N=_.plane,E=N.distanceToPoint(this.a),R=N.distanceToPoint(this.b),L=N.distanceToPoint(this.c);qn(E)&&(E=0),qn(R)&&(R=0),qn(L)&&(L=0);let O=E*R,I=E*L;if(O>0&&I>0)return!1;let k=S.distanceToPoint(_.a),H=S.distanceToPoint(_.b),W=S.distanceToPoint(_.c);qn(k)&&(k=0),qn(H)&&(H=0),qn(W)&&(W=0);let te=k*H,q=k*W;if(te>0&&q>0)return!1;s.copy(S.normal),r.copy(N.normal);let Q=s.cross(r),ee=0,be=Math.abs(Q.x),Oe=Math.abs(Q.y);Oe>be&&(be=Oe,ee=1),Math.abs(Q.z)>be&&(ee=2);let he=YS[ee],ve=this.a[he],Ce=this.b[he],pe=this.c[he],Fe=_.a[he],Rt=_.b[he],Pe=_.c[he];if(p(this,ve,Ce,pe,O,I,E,R,L,h,a))return d(this,_,M,A);if(p(_,Fe,Rt,Pe,te,q,k,H,W,u,l))return d(this,_,M,A);if(h.y<h.x){let nt=h.y;h.y=h.x,h.x=nt,c.copy(a.start),a.start.copy(a.end),a.end.copy(c)}if(u.y<u.x){let nt=u.y;u.y=u.x,u.x=nt,c.copy(l.start),l.start.copy(l.end),l.end.copy(c)}return h.y<u.x||u.y<h.x?!1:(M&&(u.x>h.x?M.start.copy(l.start):M.start.copy(a.start),u.y<h.y?M.end.copy(l.end):M.end.copy(a.end)),!0)}})();Jt.prototype.distanceToPoint=(function(){let i=new C;return function(t){return this.closestPointToPoint(t,i),t.distanceTo(i)}})();Jt.prototype.distanceToTriangle=(function(){let i=new C,e=new C,t=["a","b","c"],n=new _n,s=new _n;return function(o,a=null,l=null){let c=a||l?n:null;if(this.intersectsTriangle(o,c,!0))return(a||l)&&(a&&c.getCenter(a),l&&c.getCenter(l)),0;let h=1/0;for(let u=0;u<3;u++){let d,f=t[u],p=o[f];this.closestPointToPoint(p,i),d=p.distanceToSquared(i),d<h&&(h=d,a&&a.copy(i),l&&l.copy(p));let v=this[f];o.closestPointToPoint(v,i),d=v.distanceToSquared(i),d<h&&(h=d,a&&a.copy(v),l&&l.copy(i))}for(let u=0;u<3;u++){let d=t[u],f=t[(u+1)%3];n.set(this[d],this[f]);for(let p=0;p<3;p++){let v=t[p],m=t[(p+1)%3];s.set(o[v],o[m]),ko(n,s,i,e);let g=i.distanceToSquared(e);g<h&&(h=g,a&&a.copy(i),l&&l.copy(e))}}return Math.sqrt(h)}})();var Pt=class{constructor(e,t,n){this.isOrientedBox=!0,this.min=new C,this.max=new C,this.matrix=new Le,this.invMatrix=new Le,this.points=new Array(8).fill().map(()=>new C),this.satAxes=new Array(3).fill().map(()=>new C),this.satBounds=new Array(3).fill().map(()=>new On),this.alignedSatBounds=new Array(3).fill().map(()=>new On),this.needsUpdate=!1,e&&this.min.copy(e),t&&this.max.copy(t),n&&this.matrix.copy(n)}set(e,t,n){this.min.copy(e),this.max.copy(t),this.matrix.copy(n),this.needsUpdate=!0}copy(e){this.min.copy(e.min),this.max.copy(e.max),this.matrix.copy(e.matrix),this.needsUpdate=!0}};Pt.prototype.update=(function(){return function(){let e=this.matrix,t=this.min,n=this.max,s=this.points;for(let c=0;c<=1;c++)for(let h=0;h<=1;h++)for(let u=0;u<=1;u++){let d=1*c|2*h|4*u,f=s[d];f.x=c?n.x:t.x,f.y=h?n.y:t.y,f.z=u?n.z:t.z,f.applyMatrix4(e)}let r=this.satBounds,o=this.satAxes,a=s[0];for(let c=0;c<3;c++){let h=o[c],u=r[c],d=1<<c,f=s[d];h.subVectors(a,f),u.setFromPoints(h,s)}let l=this.alignedSatBounds;l[0].setFromPointsField(s,"x"),l[1].setFromPointsField(s,"y"),l[2].setFromPointsField(s,"z"),this.invMatrix.copy(this.matrix).invert(),this.needsUpdate=!1}})();Pt.prototype.intersectsBox=(function(){let i=new On;return function(t){this.needsUpdate&&this.update();let n=t.min,s=t.max,r=this.satBounds,o=this.satAxes,a=this.alignedSatBounds;if(i.min=n.x,i.max=s.x,a[0].isSeparated(i)||(i.min=n.y,i.max=s.y,a[1].isSeparated(i))||(i.min=n.z,i.max=s.z,a[2].isSeparated(i)))return!1;for(let l=0;l<3;l++){let c=o[l],h=r[l];if(i.setFromBox(c,t),h.isSeparated(i))return!1}return!0}})();Pt.prototype.intersectsTriangle=(function(){let i=new Jt,e=new Array(3),t=new On,n=new On,s=new C;return function(o){this.needsUpdate&&this.update(),o.isExtendedTriangle?o.needsUpdate&&o.update():(i.copy(o),i.update(),o=i);let a=this.satBounds,l=this.satAxes;e[0]=o.a,e[1]=o.b,e[2]=o.c;for(let d=0;d<3;d++){let f=a[d],p=l[d];if(t.setFromPoints(p,e),f.isSeparated(t))return!1}let c=o.satBounds,h=o.satAxes,u=this.points;for(let d=0;d<3;d++){let f=c[d],p=h[d];if(t.setFromPoints(p,u),f.isSeparated(t))return!1}for(let d=0;d<3;d++){let f=l[d];for(let p=0;p<4;p++){let v=h[p];if(s.crossVectors(f,v),t.setFromPoints(s,e),n.setFromPoints(s,u),t.isSeparated(n))return!1}}return!0}})();Pt.prototype.closestPointToPoint=(function(){return function(e,t){return this.needsUpdate&&this.update(),t.copy(e).applyMatrix4(this.invMatrix).clamp(this.min,this.max).applyMatrix4(this.matrix),t}})();Pt.prototype.distanceToPoint=(function(){let i=new C;return function(t){return this.closestPointToPoint(t,i),t.distanceTo(i)}})();Pt.prototype.distanceToBox=(function(){let i=["x","y","z"],e=new Array(12).fill().map(()=>new _n),t=new Array(12).fill().map(()=>new _n),n=new C,s=new C;return function(o,a=0,l=null,c=null){if(this.needsUpdate&&this.update(),this.intersectsBox(o))return(l||c)&&(o.getCenter(s),this.closestPointToPoint(s,n),o.closestPointToPoint(n,s),l&&l.copy(n),c&&c.copy(s)),0;let h=a*a,u=o.min,d=o.max,f=this.points,p=1/0;for(let m=0;m<8;m++){let g=f[m];s.copy(g).clamp(u,d);let x=g.distanceToSquared(s);if(x<p&&(p=x,l&&l.copy(g),c&&c.copy(s),x<h))return Math.sqrt(x)}let v=0;for(let m=0;m<3;m++)for(let g=0;g<=1;g++)for(let x=0;x<=1;x++){let b=(m+1)%3,_=(m+2)%3,M=g<<b|x<<_,A=1<<m|g<<b|x<<_,y=f[M],S=f[A];e[v].set(y,S);let E=i[m],R=i[b],L=i[_],O=t[v],I=O.start,k=O.end;I[E]=u[E],I[R]=g?u[R]:d[R],I[L]=x?u[L]:d[L],k[E]=d[E],k[R]=g?u[R]:d[R],k[L]=x?u[L]:d[L],v++}for(let m=0;m<=1;m++)for(let g=0;g<=1;g++)for(let x=0;x<=1;x++){s.x=m?d.x:u.x,s.y=g?d.y:u.y,s.z=x?d.z:u.z,this.closestPointToPoint(s,n);let b=s.distanceToSquared(n);if(b<p&&(p=b,l&&l.copy(n),c&&c.copy(s),b<h))return Math.sqrt(b)}for(let m=0;m<12;m++){let g=e[m];for(let x=0;x<12;x++){let b=t[x];ko(g,b,n,s);let _=n.distanceToSquared(s);if(_<p&&(p=_,l&&l.copy(n),c&&c.copy(s),_<h))return Math.sqrt(_)}}return Math.sqrt(p)}})();var Pd=class extends ji{constructor(){super(()=>new Jt)}},bn=new Pd;var zo=new C,Id=new C;function Rg(i,e,t={},n=0,s=1/0){let r=n*n,o=s*s,a=1/0,l=null;if(i.shapecast({boundsTraverseOrder:h=>(zo.copy(e).clamp(h.min,h.max),zo.distanceToSquared(e)),intersectsBounds:(h,u,d)=>d<a&&d<o,intersectsTriangle:(h,u)=>{h.closestPointToPoint(e,zo);let d=e.distanceToSquared(zo);return d<a&&(Id.copy(zo),a=d,l=u),d<r}}),a===1/0)return null;let c=Math.sqrt(a);return t.point?t.point.copy(Id):t.point=Id.clone(),t.distance=c,t.faceIndex=l,t}var Tc=parseInt("187")>=169,jS=parseInt("187")<=161,xs=new C,_s=new C,vs=new C,Ac=new _e,Ec=new _e,Cc=new _e,Pg=new C,Ig=new C,Lg=new C,Vo=new C;function ZS(i,e,t,n,s,r,o,a){let l;if(r===Zt?l=i.intersectTriangle(n,t,e,!0,s):l=i.intersectTriangle(e,t,n,r!==wt,s),l===null)return null;let c=i.origin.distanceTo(s);return c<o||c>a?null:{distance:c,point:s.clone()}}function Ng(i,e,t,n,s,r,o,a,l,c,h){xs.fromBufferAttribute(e,r),_s.fromBufferAttribute(e,o),vs.fromBufferAttribute(e,a);let u=ZS(i,xs,_s,vs,Vo,l,c,h);if(u){if(n){Ac.fromBufferAttribute(n,r),Ec.fromBufferAttribute(n,o),Cc.fromBufferAttribute(n,a),u.uv=new _e;let f=Yt.getInterpolation(Vo,xs,_s,vs,Ac,Ec,Cc,u.uv);Tc||(u.uv=f)}if(s){Ac.fromBufferAttribute(s,r),Ec.fromBufferAttribute(s,o),Cc.fromBufferAttribute(s,a),u.uv1=new _e;let f=Yt.getInterpolation(Vo,xs,_s,vs,Ac,Ec,Cc,u.uv1);Tc||(u.uv1=f),jS&&(u.uv2=u.uv1)}if(t){Pg.fromBufferAttribute(t,r),Ig.fromBufferAttribute(t,o),Lg.fromBufferAttribute(t,a),u.normal=new C;let f=Yt.getInterpolation(Vo,xs,_s,vs,Pg,Ig,Lg,u.normal);u.normal.dot(i.direction)>0&&u.normal.multiplyScalar(-1),Tc||(u.normal=f)}let d={a:r,b:o,c:a,normal:new C,materialIndex:0};if(Yt.getNormal(xs,_s,vs,d.normal),u.face=d,u.faceIndex=r,Tc){let f=new C;Yt.getBarycoord(Vo,xs,_s,vs,f),u.barycoord=f}}return u}function Dg(i){return i&&i.isMaterial?i.side:i}function Sr(i,e,t,n,s,r,o){let a=n*3,l=a+0,c=a+1,h=a+2,{index:u,groups:d}=i;i.index&&(l=u.getX(l),c=u.getX(c),h=u.getX(h));let{position:f,normal:p,uv:v,uv1:m}=i.attributes;if(Array.isArray(e)){let g=n*3;for(let x=0,b=d.length;x<b;x++){let{start:_,count:M,materialIndex:A}=d[x];if(g>=_&&g<_+M){let y=Dg(e[A]),S=Ng(t,f,p,v,m,l,c,h,y,r,o);if(S)if(S.faceIndex=n,S.face.materialIndex=A,s)s.push(S);else return S}}}else{let g=Dg(e),x=Ng(t,f,p,v,m,l,c,h,g,r,o);if(x)if(x.faceIndex=n,x.face.materialIndex=0,s)s.push(x);else return x}return null}function yt(i,e,t,n){let s=i.a,r=i.b,o=i.c,a=e,l=e+1,c=e+2;t&&(a=t.getX(a),l=t.getX(l),c=t.getX(c)),s.x=n.getX(a),s.y=n.getY(a),s.z=n.getZ(a),r.x=n.getX(l),r.y=n.getY(l),r.z=n.getZ(l),o.x=n.getX(c),o.y=n.getY(c),o.z=n.getZ(c)}function Og(i,e,t,n,s,r,o,a){let{geometry:l,_indirectBuffer:c}=i;for(let h=n,u=n+s;h<u;h++)Sr(l,e,t,h,r,o,a)}function Ug(i,e,t,n,s,r,o){let{geometry:a,_indirectBuffer:l}=i,c=1/0,h=null;for(let u=n,d=n+s;u<d;u++){let f;f=Sr(a,e,t,u,null,r,o),f&&f.distance<c&&(h=f,c=f.distance)}return h}function Fg(i,e,t,n,s,r,o){let{geometry:a}=t,{index:l}=a,c=a.attributes.position;for(let h=i,u=e+i;h<u;h++){let d;if(d=h,yt(o,d*3,l,c),o.needsUpdate=!0,n(o,d,s,r))return!0}return!1}function Bg(i,e=null){e&&Array.isArray(e)&&(e=new Set(e));let t=i.geometry,n=t.index?t.index.array:null,s=t.attributes.position,r,o,a,l,c=0,h=i._roots;for(let d=0,f=h.length;d<f;d++)r=h[d],o=new Uint32Array(r),a=new Uint16Array(r),l=new Float32Array(r),u(0,c),c+=r.byteLength;function u(d,f,p=!1){let v=d*2;if(et(v,a)){let m=ut(d,o),g=ft(v,a),x=1/0,b=1/0,_=1/0,M=-1/0,A=-1/0,y=-1/0;for(let S=3*m,N=3*(m+g);S<N;S++){let E=n[S],R=s.getX(E),L=s.getY(E),O=s.getZ(E);R<x&&(x=R),R>M&&(M=R),L<b&&(b=L),L>A&&(A=L),O<_&&(_=O),O>y&&(y=O)}return l[d+0]!==x||l[d+1]!==b||l[d+2]!==_||l[d+3]!==M||l[d+4]!==A||l[d+5]!==y?(l[d+0]=x,l[d+1]=b,l[d+2]=_,l[d+3]=M,l[d+4]=A,l[d+5]=y,!0):!1}else{let m=lt(d),g=ct(d,o),x=p,b=!1,_=!1;if(e){if(!x){let E=m/8+f/32,R=g/8+f/32;b=e.has(E),_=e.has(R),x=!b&&!_}}else b=!0,_=!0;let M=x||b,A=x||_,y=!1;M&&(y=u(m,f,x));let S=!1;A&&(S=u(g,f,x));let N=y||S;if(N)for(let E=0;E<3;E++){let R=m+E,L=g+E,O=l[R],I=l[R+3],k=l[L],H=l[L+3];l[d+E]=O<k?O:k,l[d+E+3]=I>H?I:H}return N}}}function cn(i,e,t,n,s){let r,o,a,l,c,h,u=1/t.direction.x,d=1/t.direction.y,f=1/t.direction.z,p=t.origin.x,v=t.origin.y,m=t.origin.z,g=e[i],x=e[i+3],b=e[i+1],_=e[i+3+1],M=e[i+2],A=e[i+3+2];return u>=0?(r=(g-p)*u,o=(x-p)*u):(r=(x-p)*u,o=(g-p)*u),d>=0?(a=(b-v)*d,l=(_-v)*d):(a=(_-v)*d,l=(b-v)*d),r>l||a>o||((a>r||isNaN(r))&&(r=a),(l<o||isNaN(o))&&(o=l),f>=0?(c=(M-m)*f,h=(A-m)*f):(c=(A-m)*f,h=(M-m)*f),r>h||c>o)?!1:((c>r||r!==r)&&(r=c),(h<o||o!==o)&&(o=h),r<=s&&o>=n)}function kg(i,e,t,n,s,r,o,a){let{geometry:l,_indirectBuffer:c}=i;for(let h=n,u=n+s;h<u;h++){let d=c?c[h]:h;Sr(l,e,t,d,r,o,a)}}function zg(i,e,t,n,s,r,o){let{geometry:a,_indirectBuffer:l}=i,c=1/0,h=null;for(let u=n,d=n+s;u<d;u++){let f;f=Sr(a,e,t,l?l[u]:u,null,r,o),f&&f.distance<c&&(h=f,c=f.distance)}return h}function Vg(i,e,t,n,s,r,o){let{geometry:a}=t,{index:l}=a,c=a.attributes.position;for(let h=i,u=e+i;h<u;h++){let d;if(d=t.resolveTriangleIndex(h),yt(o,d*3,l,c),o.needsUpdate=!0,n(o,d,s,r))return!0}return!1}function Gg(i,e,t,n,s,r,o){Ye.setBuffer(i._roots[e]),cn(0,Ye.float32Array,n,r,o)&&Ld(0,i,t,n,s,r,o),Ye.clearBuffer()}function Ld(i,e,t,n,s,r,o){let{float32Array:a,uint16Array:l,uint32Array:c}=Ye,h=i*2;if(et(h,l)){let d=ut(i,c),f=ft(h,l);Og(e,t,n,d,f,s,r,o)}else{let d=lt(i);cn(d,a,n,r,o)&&Ld(d,e,t,n,s,r,o);let f=ct(i,c);cn(f,a,n,r,o)&&Ld(f,e,t,n,s,r,o)}}var JS=["x","y","z"];function Hg(i,e,t,n,s,r){Ye.setBuffer(i._roots[e]);let o=null;return cn(0,Ye.float32Array,n,s,r)&&(o=Nd(0,i,t,n,s,r)),Ye.clearBuffer(),o}function Nd(i,e,t,n,s,r){let{float32Array:o,uint16Array:a,uint32Array:l}=Ye,c=i*2;if(et(c,a)){let u=ut(i,l),d=ft(c,a);return Ug(e,t,n,u,d,s,r)}else{let u=mr(i,l),d=JS[u],p=n.direction[d]>=0,v,m;p?(v=lt(i),m=ct(i,l)):(v=ct(i,l),m=lt(i));let x=cn(v,o,n,s,r)?Nd(v,e,t,n,s,r):null;if(x){let M=x.point[d];if(p?M<=o[m+u]:M>=o[m+u+3])return x}let _=cn(m,o,n,s,r)?Nd(m,e,t,n,s,r):null;return x&&_?x.distance<=_.distance?x:_:x||_||null}}var Rc=new st,wr=new Jt,Tr=new Jt,Go=new Le,Wg=new Pt,Pc=new Pt;function Xg(i,e,t,n){Ye.setBuffer(i._roots[e]);let s=Dd(0,i,t,n);return Ye.clearBuffer(),s}function Dd(i,e,t,n,s=null){let{float32Array:r,uint16Array:o,uint32Array:a}=Ye,l=i*2;if(s===null&&(t.boundingBox||t.computeBoundingBox(),Wg.set(t.boundingBox.min,t.boundingBox.max,n),s=Wg),et(l,o)){let h=e.geometry,u=h.index,d=h.attributes.position,f=t.index,p=t.attributes.position,v=ut(i,a),m=ft(l,o);if(Go.copy(n).invert(),t.boundsTree)return gt(i,r,Pc),Pc.matrix.copy(Go),Pc.needsUpdate=!0,t.boundsTree.shapecast({intersectsBounds:x=>Pc.intersectsBox(x),intersectsTriangle:x=>{x.a.applyMatrix4(n),x.b.applyMatrix4(n),x.c.applyMatrix4(n),x.needsUpdate=!0;for(let b=v*3,_=(m+v)*3;b<_;b+=3)if(yt(Tr,b,u,d),Tr.needsUpdate=!0,x.intersectsTriangle(Tr))return!0;return!1}});{let g=Ki(t);for(let x=v*3,b=(m+v)*3;x<b;x+=3){yt(wr,x,u,d),wr.a.applyMatrix4(Go),wr.b.applyMatrix4(Go),wr.c.applyMatrix4(Go),wr.needsUpdate=!0;for(let _=0,M=g*3;_<M;_+=3)if(yt(Tr,_,f,p),Tr.needsUpdate=!0,wr.intersectsTriangle(Tr))return!0}}}else{let h=lt(i),u=ct(i,a);return gt(h,r,Rc),!!(s.intersectsBox(Rc)&&Dd(h,e,t,n,s)||(gt(u,r,Rc),s.intersectsBox(Rc)&&Dd(u,e,t,n,s)))}}var Ic=new Le,Od=new Pt,Ho=new Pt,KS=new C,QS=new C,ew=new C,tw=new C;function qg(i,e,t,n={},s={},r=0,o=1/0){e.boundingBox||e.computeBoundingBox(),Od.set(e.boundingBox.min,e.boundingBox.max,t),Od.needsUpdate=!0;let a=i.geometry,l=a.attributes.position,c=a.index,h=e.attributes.position,u=e.index,d=bn.getPrimitive(),f=bn.getPrimitive(),p=KS,v=QS,m=null,g=null;s&&(m=ew,g=tw);let x=1/0,b=null,_=null;return Ic.copy(t).invert(),Ho.matrix.copy(Ic),i.shapecast({boundsTraverseOrder:M=>Od.distanceToBox(M),intersectsBounds:(M,A,y)=>y<x&&y<o?(A&&(Ho.min.copy(M.min),Ho.max.copy(M.max),Ho.needsUpdate=!0),!0):!1,intersectsRange:(M,A)=>{if(e.boundsTree)return e.boundsTree.shapecast({boundsTraverseOrder:S=>Ho.distanceToBox(S),intersectsBounds:(S,N,E)=>E<x&&E<o,intersectsRange:(S,N)=>{for(let E=S,R=S+N;E<R;E++){yt(f,3*E,u,h),f.a.applyMatrix4(t),f.b.applyMatrix4(t),f.c.applyMatrix4(t),f.needsUpdate=!0;for(let L=M,O=M+A;L<O;L++){yt(d,3*L,c,l),d.needsUpdate=!0;let I=d.distanceToTriangle(f,p,m);if(I<x&&(v.copy(p),g&&g.copy(m),x=I,b=L,_=E),I<r)return!0}}}});{let y=Ki(e);for(let S=0,N=y;S<N;S++){yt(f,3*S,u,h),f.a.applyMatrix4(t),f.b.applyMatrix4(t),f.c.applyMatrix4(t),f.needsUpdate=!0;for(let E=M,R=M+A;E<R;E++){yt(d,3*E,c,l),d.needsUpdate=!0;let L=d.distanceToTriangle(f,p,m);if(L<x&&(v.copy(p),g&&g.copy(m),x=L,b=E,_=S),L<r)return!0}}}}}),bn.releasePrimitive(d),bn.releasePrimitive(f),x===1/0?null:(n.point?n.point.copy(v):n.point=v.clone(),n.distance=x,n.faceIndex=b,s&&(s.point?s.point.copy(g):s.point=g.clone(),s.point.applyMatrix4(Ic),v.applyMatrix4(Ic),s.distance=v.sub(s.point).length(),s.faceIndex=_),n)}function $g(i,e=null){e&&Array.isArray(e)&&(e=new Set(e));let t=i.geometry,n=t.index?t.index.array:null,s=t.attributes.position,r,o,a,l,c=0,h=i._roots;for(let d=0,f=h.length;d<f;d++)r=h[d],o=new Uint32Array(r),a=new Uint16Array(r),l=new Float32Array(r),u(0,c),c+=r.byteLength;function u(d,f,p=!1){let v=d*2;if(et(v,a)){let m=ut(d,o),g=ft(v,a),x=1/0,b=1/0,_=1/0,M=-1/0,A=-1/0,y=-1/0;for(let S=m,N=m+g;S<N;S++){let E=3*i.resolveTriangleIndex(S);for(let R=0;R<3;R++){let L=E+R;L=n?n[L]:L;let O=s.getX(L),I=s.getY(L),k=s.getZ(L);O<x&&(x=O),O>M&&(M=O),I<b&&(b=I),I>A&&(A=I),k<_&&(_=k),k>y&&(y=k)}}return l[d+0]!==x||l[d+1]!==b||l[d+2]!==_||l[d+3]!==M||l[d+4]!==A||l[d+5]!==y?(l[d+0]=x,l[d+1]=b,l[d+2]=_,l[d+3]=M,l[d+4]=A,l[d+5]=y,!0):!1}else{let m=lt(d),g=ct(d,o),x=p,b=!1,_=!1;if(e){if(!x){let E=m/8+f/32,R=g/8+f/32;b=e.has(E),_=e.has(R),x=!b&&!_}}else b=!0,_=!0;let M=x||b,A=x||_,y=!1;M&&(y=u(m,f,x));let S=!1;A&&(S=u(g,f,x));let N=y||S;if(N)for(let E=0;E<3;E++){let R=m+E,L=g+E,O=l[R],I=l[R+3],k=l[L],H=l[L+3];l[d+E]=O<k?O:k,l[d+E+3]=I>H?I:H}return N}}}function Yg(i,e,t,n,s,r,o){Ye.setBuffer(i._roots[e]),cn(0,Ye.float32Array,n,r,o)&&Ud(0,i,t,n,s,r,o),Ye.clearBuffer()}function Ud(i,e,t,n,s,r,o){let{float32Array:a,uint16Array:l,uint32Array:c}=Ye,h=i*2;if(et(h,l)){let d=ut(i,c),f=ft(h,l);kg(e,t,n,d,f,s,r,o)}else{let d=lt(i);cn(d,a,n,r,o)&&Ud(d,e,t,n,s,r,o);let f=ct(i,c);cn(f,a,n,r,o)&&Ud(f,e,t,n,s,r,o)}}var nw=["x","y","z"];function jg(i,e,t,n,s,r){Ye.setBuffer(i._roots[e]);let o=null;return cn(0,Ye.float32Array,n,s,r)&&(o=Fd(0,i,t,n,s,r)),Ye.clearBuffer(),o}function Fd(i,e,t,n,s,r){let{float32Array:o,uint16Array:a,uint32Array:l}=Ye,c=i*2;if(et(c,a)){let u=ut(i,l),d=ft(c,a);return zg(e,t,n,u,d,s,r)}else{let u=mr(i,l),d=nw[u],p=n.direction[d]>=0,v,m;p?(v=lt(i),m=ct(i,l)):(v=ct(i,l),m=lt(i));let x=cn(v,o,n,s,r)?Fd(v,e,t,n,s,r):null;if(x){let M=x.point[d];if(p?M<=o[m+u]:M>=o[m+u+3])return x}let _=cn(m,o,n,s,r)?Fd(m,e,t,n,s,r):null;return x&&_?x.distance<=_.distance?x:_:x||_||null}}var Lc=new st,Ar=new Jt,Er=new Jt,Wo=new Le,Zg=new Pt,Nc=new Pt;function Jg(i,e,t,n){Ye.setBuffer(i._roots[e]);let s=Bd(0,i,t,n);return Ye.clearBuffer(),s}function Bd(i,e,t,n,s=null){let{float32Array:r,uint16Array:o,uint32Array:a}=Ye,l=i*2;if(s===null&&(t.boundingBox||t.computeBoundingBox(),Zg.set(t.boundingBox.min,t.boundingBox.max,n),s=Zg),et(l,o)){let h=e.geometry,u=h.index,d=h.attributes.position,f=t.index,p=t.attributes.position,v=ut(i,a),m=ft(l,o);if(Wo.copy(n).invert(),t.boundsTree)return gt(i,r,Nc),Nc.matrix.copy(Wo),Nc.needsUpdate=!0,t.boundsTree.shapecast({intersectsBounds:x=>Nc.intersectsBox(x),intersectsTriangle:x=>{x.a.applyMatrix4(n),x.b.applyMatrix4(n),x.c.applyMatrix4(n),x.needsUpdate=!0;for(let b=v,_=m+v;b<_;b++)if(yt(Er,3*e.resolveTriangleIndex(b),u,d),Er.needsUpdate=!0,x.intersectsTriangle(Er))return!0;return!1}});{let g=Ki(t);for(let x=v,b=m+v;x<b;x++){let _=e.resolveTriangleIndex(x);yt(Ar,3*_,u,d),Ar.a.applyMatrix4(Wo),Ar.b.applyMatrix4(Wo),Ar.c.applyMatrix4(Wo),Ar.needsUpdate=!0;for(let M=0,A=g*3;M<A;M+=3)if(yt(Er,M,f,p),Er.needsUpdate=!0,Ar.intersectsTriangle(Er))return!0}}}else{let h=lt(i),u=ct(i,a);return gt(h,r,Lc),!!(s.intersectsBox(Lc)&&Bd(h,e,t,n,s)||(gt(u,r,Lc),s.intersectsBox(Lc)&&Bd(u,e,t,n,s)))}}var Dc=new Le,kd=new Pt,Xo=new Pt,iw=new C,sw=new C,rw=new C,ow=new C;function Kg(i,e,t,n={},s={},r=0,o=1/0){e.boundingBox||e.computeBoundingBox(),kd.set(e.boundingBox.min,e.boundingBox.max,t),kd.needsUpdate=!0;let a=i.geometry,l=a.attributes.position,c=a.index,h=e.attributes.position,u=e.index,d=bn.getPrimitive(),f=bn.getPrimitive(),p=iw,v=sw,m=null,g=null;s&&(m=rw,g=ow);let x=1/0,b=null,_=null;return Dc.copy(t).invert(),Xo.matrix.copy(Dc),i.shapecast({boundsTraverseOrder:M=>kd.distanceToBox(M),intersectsBounds:(M,A,y)=>y<x&&y<o?(A&&(Xo.min.copy(M.min),Xo.max.copy(M.max),Xo.needsUpdate=!0),!0):!1,intersectsRange:(M,A)=>{if(e.boundsTree){let y=e.boundsTree;return y.shapecast({boundsTraverseOrder:S=>Xo.distanceToBox(S),intersectsBounds:(S,N,E)=>E<x&&E<o,intersectsRange:(S,N)=>{for(let E=S,R=S+N;E<R;E++){let L=y.resolveTriangleIndex(E);yt(f,3*L,u,h),f.a.applyMatrix4(t),f.b.applyMatrix4(t),f.c.applyMatrix4(t),f.needsUpdate=!0;for(let O=M,I=M+A;O<I;O++){let k=i.resolveTriangleIndex(O);yt(d,3*k,c,l),d.needsUpdate=!0;let H=d.distanceToTriangle(f,p,m);if(H<x&&(v.copy(p),g&&g.copy(m),x=H,b=O,_=E),H<r)return!0}}}})}else{let y=Ki(e);for(let S=0,N=y;S<N;S++){yt(f,3*S,u,h),f.a.applyMatrix4(t),f.b.applyMatrix4(t),f.c.applyMatrix4(t),f.needsUpdate=!0;for(let E=M,R=M+A;E<R;E++){let L=i.resolveTriangleIndex(E);yt(d,3*L,c,l),d.needsUpdate=!0;let O=d.distanceToTriangle(f,p,m);if(O<x&&(v.copy(p),g&&g.copy(m),x=O,b=E,_=S),O<r)return!0}}}}}),bn.releasePrimitive(d),bn.releasePrimitive(f),x===1/0?null:(n.point?n.point.copy(v):n.point=v.clone(),n.distance=x,n.faceIndex=b,s&&(s.point?s.point.copy(g):s.point=g.clone(),s.point.applyMatrix4(Dc),v.applyMatrix4(Dc),s.distance=v.sub(s.point).length(),s.faceIndex=_),n)}function zd(i,e,t){return i===null?null:(i.point.applyMatrix4(e.matrixWorld),i.distance=i.point.distanceTo(t.ray.origin),i.object=e,i)}var Oc=new Pt,Uc=new Kn,Qg=new C,e0=new Le,t0=new C,Vd=["getX","getY","getZ"],Fc=class i extends wc{static serialize(e,t={}){t={cloneBuffers:!0,...t};let n=e.geometry,s=e._roots,r=e._indirectBuffer,o=n.getIndex(),a={version:1,roots:null,index:null,indirectBuffer:null};return t.cloneBuffers?(a.roots=s.map(l=>l.slice()),a.index=o?o.array.slice():null,a.indirectBuffer=r?r.slice():null):(a.roots=s,a.index=o?o.array:null,a.indirectBuffer=r),a}static deserialize(e,t,n={}){n={setIndex:!0,indirect:!!e.indirectBuffer,...n};let{index:s,roots:r,indirectBuffer:o}=e;e.version||(console.warn("MeshBVH.deserialize: Serialization format has been changed and will be fixed up. It is recommended to regenerate any stored serialized data."),l(r));let a=new i(t,{...n,[Uo]:!0});if(a._roots=r,a._indirectBuffer=o||null,n.setIndex){let c=t.getIndex();if(c===null){let h=new Qe(e.index,1,!1);t.setIndex(h)}else c.array!==s&&(c.array.set(s),c.needsUpdate=!0)}return a;function l(c){for(let h=0;h<c.length;h++){let u=c[h],d=new Uint32Array(u),f=new Uint16Array(u);for(let p=0,v=u.byteLength/32;p<v;p++){let m=8*p,g=2*m;et(g,f)||(d[m+6]=d[m+6]/8-p)}}}}get primitiveStride(){return 3}get resolveTriangleIndex(){return this.resolvePrimitiveIndex}constructor(e,t={}){t.maxLeafTris&&(console.warn('MeshBVH: "maxLeafTris" option has been deprecated. Use "targetLeafSize", instead.'),t={...t,targetLeafSize:t.maxLeafTris}),super(e,t)}shiftTriangleOffsets(e){return super.shiftPrimitiveOffsets(e)}writePrimitiveBounds(e,t,n){let s=this.geometry,r=this._indirectBuffer,o=s.attributes.position,a=s.index?s.index.array:null,c=(r?r[e]:e)*3,h=c+0,u=c+1,d=c+2;a&&(h=a[h],u=a[u],d=a[d]);for(let f=0;f<3;f++){let p=o[Vd[f]](h),v=o[Vd[f]](u),m=o[Vd[f]](d),g=p;v<g&&(g=v),m<g&&(g=m);let x=p;v>x&&(x=v),m>x&&(x=m),t[n+f]=g,t[n+f+3]=x}return t}computePrimitiveBounds(e,t,n){let s=this.geometry,r=this._indirectBuffer,o=s.attributes.position,a=s.index?s.index.array:null,l=o.normalized;if(e<0||t+e-n.offset>n.length/6)throw new Error("MeshBVH: compute triangle bounds range is invalid.");let c=o.array,h=o.offset||0,u=3;o.isInterleavedBufferAttribute&&(u=o.data.stride);let d=["getX","getY","getZ"],f=n.offset;for(let p=e,v=e+t;p<v;p++){let g=(r?r[p]:p)*3,x=(p-f)*6,b=g+0,_=g+1,M=g+2;a&&(b=a[b],_=a[_],M=a[M]),l||(b=b*u+h,_=_*u+h,M=M*u+h);for(let A=0;A<3;A++){let y,S,N;l?(y=o[d[A]](b),S=o[d[A]](_),N=o[d[A]](M)):(y=c[b+A],S=c[_+A],N=c[M+A]);let E=y;S<E&&(E=S),N<E&&(E=N);let R=y;S>R&&(R=S),N>R&&(R=N);let L=(R-E)/2,O=A*2;n[x+O+0]=E+L,n[x+O+1]=L+(Math.abs(E)+L)*pr}}return n}raycastObject3D(e,t,n=[]){let{material:s}=e;if(s===void 0)return;e0.copy(e.matrixWorld).invert(),Uc.copy(t.ray).applyMatrix4(e0),t0.setFromMatrixScale(e.matrixWorld),Qg.copy(Uc.direction).multiply(t0);let r=Qg.length(),o=t.near/r,a=t.far/r;if(t.firstHitOnly===!0){let l=this.raycastFirst(Uc,s,o,a);l=zd(l,e,t),l&&n.push(l)}else{let l=this.raycast(Uc,s,o,a);for(let c=0,h=l.length;c<h;c++){let u=zd(l[c],e,t);u&&n.push(u)}}return n}refit(e=null){return(this.indirect?$g:Bg)(this,e)}raycast(e,t=Nn,n=0,s=1/0){let r=this._roots,o=[],a=this.indirect?Yg:Gg;for(let l=0,c=r.length;l<c;l++)a(this,l,t,e,o,n,s);return o}raycastFirst(e,t=Nn,n=0,s=1/0){let r=this._roots,o=null,a=this.indirect?jg:Hg;for(let l=0,c=r.length;l<c;l++){let h=a(this,l,t,e,n,s);h!=null&&(o==null||h.distance<o.distance)&&(o=h)}return o}intersectsGeometry(e,t){let n=!1,s=this._roots,r=this.indirect?Jg:Xg;for(let o=0,a=s.length;o<a&&(n=r(this,o,e,t),!n);o++);return n}shapecast(e){let t=bn.getPrimitive(),n=super.shapecast({...e,intersectsPrimitive:e.intersectsTriangle,scratchPrimitive:t,iterate:this.indirect?Vg:Fg});return bn.releasePrimitive(t),n}bvhcast(e,t,n){let{intersectsRanges:s,intersectsTriangles:r}=n,o=bn.getPrimitive(),a=this.geometry.index,l=this.geometry.attributes.position,c=this.indirect?p=>{let v=this.resolveTriangleIndex(p);yt(o,v*3,a,l)}:p=>{yt(o,p*3,a,l)},h=bn.getPrimitive(),u=e.geometry.index,d=e.geometry.attributes.position,f=e.indirect?p=>{let v=e.resolveTriangleIndex(p);yt(h,v*3,u,d)}:p=>{yt(h,p*3,u,d)};if(r){if(!(e instanceof i))throw new Error('MeshBVH: "intersectsTriangles" callback can only be used with another MeshBVH.');let p=(v,m,g,x,b,_,M,A)=>{for(let y=g,S=g+x;y<S;y++){f(y),h.a.applyMatrix4(t),h.b.applyMatrix4(t),h.c.applyMatrix4(t),h.needsUpdate=!0;for(let N=v,E=v+m;N<E;N++)if(c(N),o.needsUpdate=!0,r(o,h,N,y,b,_,M,A))return!0}return!1};if(s){let v=s;s=function(m,g,x,b,_,M,A,y){return v(m,g,x,b,_,M,A,y)?!0:p(m,g,x,b,_,M,A,y)}}else s=p}return super.bvhcast(e,t,{intersectsRanges:s})}intersectsBox(e,t){return Oc.set(e.min,e.max,t),Oc.needsUpdate=!0,this.shapecast({intersectsBounds:n=>Oc.intersectsBox(n),intersectsTriangle:n=>Oc.intersectsTriangle(n)})}intersectsSphere(e){return this.shapecast({intersectsBounds:t=>e.intersectsBox(t),intersectsTriangle:t=>t.intersectsSphere(e)})}closestPointToGeometry(e,t,n={},s={},r=0,o=1/0){return(this.indirect?Kg:qg)(this,e,t,n,s,r,o)}closestPointToPoint(e,t={},n=0,s=1/0){return Rg(this,e,t,n,s)}};var c3=parseInt("187")>=166,Cr={Mesh:Ke.prototype.raycast,Line:Hn.prototype.raycast,LineSegments:Pn.prototype.raycast,LineLoop:Zs.prototype.raycast,Points:Js.prototype.raycast,BatchedMesh:ro.prototype.raycast},Kt=new Ke,Bc=[];function n0(i,e){if(this.isBatchedMesh)aw.call(this,i,e);else{let{geometry:t}=this;if(t.boundsTree)t.boundsTree.raycastObject3D(this,i,e);else{let n;if(this instanceof Ke)n=Cr.Mesh;else if(this instanceof Pn)n=Cr.LineSegments;else if(this instanceof Zs)n=Cr.LineLoop;else if(this instanceof Hn)n=Cr.Line;else if(this instanceof Js)n=Cr.Points;else throw new Error("BVH: Fallback raycast function not found.");n.call(this,i,e)}}}function aw(i,e){if(this.boundsTrees){let t=this.boundsTrees,n=this._drawInfo||this._instanceInfo,s=this._drawRanges||this._geometryInfo,r=this.matrixWorld;Kt.material=this.material,Kt.geometry=this.geometry;let o=Kt.geometry.boundsTree,a=Kt.geometry.drawRange;Kt.geometry.boundingSphere===null&&(Kt.geometry.boundingSphere=new Wt);for(let l=0,c=n.length;l<c;l++){if(!this.getVisibleAt(l))continue;let h=n[l].geometryIndex;if(Kt.geometry.boundsTree=t[h],this.getMatrixAt(l,Kt.matrixWorld).premultiply(r),!Kt.geometry.boundsTree){this.getBoundingBoxAt(h,Kt.geometry.boundingBox),this.getBoundingSphereAt(h,Kt.geometry.boundingSphere);let u=s[h];Kt.geometry.setDrawRange(u.start,u.count)}Kt.raycast(i,Bc);for(let u=0,d=Bc.length;u<d;u++){let f=Bc[u];f.object=this,f.batchId=l,e.push(f)}Bc.length=0}Kt.geometry.boundsTree=o,Kt.geometry.drawRange=a,Kt.material=null,Kt.geometry=null}else Cr.BatchedMesh.call(this,i,e)}function lw(i,e){let t=i.length/4,n=new Int32Array(t),s=Math.max(4,Math.ceil(Math.log2(2*t+1))),r=new Int32Array(2**s).fill(-1),o=[],a=Math.ceil(65536/e),l=h=>{let[u,d,f]=[0,1,2].map(p=>Math.floor((i[4*h+p]??0)/e));return(u*a+d)*a+f},c=new Float64Array(t);for(let h=0;h<t;++h){let u=c[h]=l(h),d=Math.imul(u^Math.floor(u/4294967296),2654435761)>>>32-s;for(;;){let f=r[d]??-1;if(f===-1){r[d]=h,n[h]=o.push(h)-1;break}if(c[f]===u){n[h]=n[f]??0;break}d=d+1&r.length-1}}return cw(i,n,o.length)}function cw(i,e,t){let n=new Float64Array(4*t);for(let o=0;o<e.length;++o){let a=4*(e[o]??0);for(let l=0;l<3;++l)n[a+l]=(n[a+l]??0)+(i[4*o+l]??0);n[a+3]=(n[a+3]??0)+1}let s=new Int32Array(t).fill(-1),r=new Float64Array(t).fill(1/0);for(let o=0;o<e.length;++o){let a=e[o]??0,l=0;for(let c=0;c<3;++c)l+=((i[4*o+c]??0)-(n[4*a+c]??0)/(n[4*a+3]??1))**2;l>=(r[a]??0)||(r[a]=l,s[a]=o)}return e.map(o=>s[o]??-1)}function i0(i,e,t){let n=lw(i,Math.max(1,t)),s=e.slice(),r=0;for(let o=0;o+2<e.length;o+=3){let a=n[e[o]??0]??0,l=n[e[o+1]??0]??0,c=n[e[o+2]??0]??0;a===l||l===c||c===a||(s[r]=a,s[r+1]=l,s[r+2]=c,r+=3)}return s.slice(0,r)}var Gd={ground:{value:new C(.006,.007,.009)}},Ii={min:{value:new C(-1e9,-1e9,-1e9)},max:{value:new C(1e9,1e9,1e9)}},hw=`
  attribute vec3 color;
  uniform vec3 flatColor;
  uniform float flatShare;
  varying vec3 vColor;
  varying vec3 vAt;
  void main() {
    vec3 n = normalize(mat3(modelMatrix) * normal);
    vAt = (modelMatrix * vec4(position, 1.0)).xyz;
    vec3 toCamera = normalize(cameraPosition - vAt);
    float sky = 0.5 + 0.5 * n.z;
    float key = max(dot(n, normalize(vec3(0.35, -0.5, 0.79))), 0.0);
    float facing = abs(dot(n, toCamera));
    // What the sensor saw has its own light in it.
    float shade = mix(0.80 + 0.14 * sky + 0.16 * key, 0.34 + 0.30 * sky + 0.42 * key, flatShare);
    shade *= mix(0.86, 1.0, smoothstep(0.0, 0.55, facing));
    vColor = mix(color, flatColor, flatShare) * shade;
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  }`,uw=`
  uniform float ghost;
  uniform vec3 ground;
  uniform vec3 clipMin;
  uniform vec3 clipMax;
  varying vec3 vColor;
  varying vec3 vAt;
  void main() {
    if (any(lessThan(vAt, clipMin)) || any(greaterThan(vAt, clipMax))) discard;
    float grey = dot(vColor, vec3(0.2126, 0.7152, 0.0722));
    vec3 shown = mix(vColor, mix(vec3(grey), ground, 0.86), ghost);
    gl_FragColor = vec4(shown, 1.0);
    #include <colorspace_fragment>
  }`;function s0(){return new on({uniforms:{flatColor:{value:new C},flatShare:{value:0},ghost:{value:0},ground:Gd.ground,clipMin:Ii.min,clipMax:Ii.max},vertexShader:hw,fragmentShader:uw,side:Nn})}var Un=i=>{let{translation_m:e,rotation:t}=i;return new Le().compose(new C(e.x,e.y,e.z),new jt(t.x,t.y,t.z,t.w).normalize(),new C(1,1,1))},Hd=[0,2.5,5,10],r0=Hd.length,kc=class{constructor(e,t){this.id=t;let n=new rt;n.setAttribute("position",new Qe(e.positions,4,!0)),n.setAttribute("normal",new Qe(e.normals,4,!0)),n.setAttribute("color",new Qe(e.colors,4,!0)),n.setIndex(new Qe(e.indices,1)),n.boundingSphere=fw(e.positions),this.mesh=new Ke(n,s0()),this.mesh.name=t,this.mesh.matrixAutoUpdate=!1,this.mesh.raycast=(r,o)=>{let a=n.boundingSphere.clone().applyMatrix4(this.mesh.matrixWorld);r.ray.intersectsSphere(a)&&(n.boundsTree||(n.boundsTree=new Fc(n)),n0.call(this.mesh,r,o))},this.levels=[n],this.edge=dw(e.positions,e.indices);let s=e.scale_m;this.fromSteps=new Le().makeTranslation(...e.offset_m).multiply(new Le().makeScale(s,s,s)),this.numTriangles=e.indices.length/3,this.bytes=e.bytes}id;mesh;numTriangles;bytes;fromSteps;edge;levels;setPose(e){this.mesh.matrix.copy(Un(e)).multiply(this.fromSteps),this.mesh.matrixWorldNeedsUpdate=!0}setLook(e,t){let{uniforms:n}=this.mesh.material;n.flatShare.value=e?1:0,e&&n.flatColor.value.fromArray(e),n.ghost.value=t}errorOf_m(e){return(Hd[e]??0)*this.edge*this.fromSteps.getMaxScaleOnAxis()}trianglesOf(e){return this.levels[e]?this.levels[e].index.count/3:this.numTriangles/4**e}geometryOf(e){let t=this.levels[e];if(t)return t;let n=this.levels[0],s=n.index.array,r=new rt;for(let[a,l]of Object.entries(n.attributes))r.setAttribute(a,l);let o=(Hd[e]??0)*this.edge;return r.setIndex(new Qe(i0(n.attributes.position.array,s,o),1)),r.boundingSphere=n.boundingSphere,this.levels[e]=r}dispose(){this.mesh.removeFromParent(),delete this.mesh.geometry.boundsTree;for(let e of this.levels)e?.dispose();this.mesh.material.dispose()}};function dw(i,e){let n=3*Math.max(1,Math.floor(e.length/3/200)),s=0,r=0;for(let o=0;o+1<e.length;o+=n){let[a,l]=[4*(e[o]??0),4*(e[o+1]??0)];s+=Math.hypot(...[0,1,2].map(c=>(i[a+c]??0)-(i[l+c]??0))),++r}return r===0?1:s/r}function fw(i){let e=[0,0,0];for(let n=0;n<i.length;n+=4)for(let s=0;s<3;++s)e[s]=Math.max(e[s]??0,i[n+s]??0);let t=new C(e[0],e[1],e[2]).multiplyScalar(.5/65535);return new Wt(t,t.length())}var zc=i=>{let e=new C,t=new jt;return i.decompose(e,t,new C),{translation_m:{x:e.x,y:e.y,z:e.z},rotation:{x:t.x,y:t.y,z:t.z,w:t.w}}};function $n(i){let e=i.box?.pose.translation_m??i.sphere?.center??i.pose.translation_m;return new C(e.x,e.y,e.z)}var qo=(i,e)=>zc(new Le().makeTranslation(e).multiply(Un(i)));function Wd(i,e,t){let n=new Le().makeTranslation(e).multiply(new Le().makeRotationZ(t)).multiply(new Le().makeTranslation(e.clone().negate()));return zc(n.multiply(Un(i)))}function o0(i,e,t){let n={x:Math.cos(e),y:Math.sin(e),z:0},s=$n(i);return{by:"plane",normal:n,point_m:{x:s.x+t*n.x,y:s.y+t*n.y,z:s.z}}}var Vc=class{constructor(e,t,n){this.store=e;this.renderer=t;this.edits=n;e.follow(["draft"],()=>this.show()),e.follow(["draft","revision"],()=>this.update()),e.follow(["selected","objects"],()=>this.dropIfGone())}store;renderer;edits;plane=new Ke(new In(1,1),new Ft({color:"#E6E9EF",transparent:!0,opacity:.35,side:wt,depthWrite:!1}));isAsking=!1;isStale=!1;choose(e){let t=this.store.get("draft"),n=this.store.get("objects").get(e);t?.is!=="merge"||e===t.id||(n?.kind==="thing"?this.store.set("draft",{...t,other:e}):this.store.set("toast",{text:`${n?.label??"That"} is a background: things alone are merged`,tone:"problem"}))}dropIfGone(){let e=this.store.get("draft");e&&(this.store.get("selected")!==e.id||!this.store.get("objects").has(e.id))&&this.store.set("draft",null)}update(){this.store.get("draft")?this.isAsking?this.isStale=!0:this.ask():this.store.set("trial",null)}async ask(){let e=this.store.get("draft");if(!e)return;this.isAsking=!0,this.isStale=!1;let t=await this.edits.tryOut(e);this.store.get("draft")===e&&this.store.set("trial",t),this.isAsking=!1,this.isStale&&this.update()}show(){let e=this.store.get("draft");this.plane.removeFromParent();let t=this.store.get("objects").get(e?.id??"");if(e?.is==="split"&&e.cut.by==="plane"&&t?.box){let{point_m:n,normal:s}=e.cut,{x:r,y:o,z:a}=t.box.size_m;this.plane.position.set(n.x,n.y,n.z),this.plane.scale.set(Math.hypot(r,o)+.2,a+.2,1),this.plane.up.set(0,0,1),this.plane.lookAt(new C(n.x+s.x,n.y+s.y,n.z+s.z)),this.renderer.addToScene(this.plane)}this.renderer.frames.invalidate()}};function a0(i,e){let t=U("h2"),n=U("p"),s=U("p",{class:"muted",role:"status"}),r=ye(null,"Merge","Do it",()=>{let l=i.get("draft");l&&e.make(l)}),o=mw(i),a=U("section",{class:"card draft"},t,n,o,s,U("div",{class:"buttons"},r,ye(null,"Cancel","Leave it (Esc)",()=>i.set("draft",null))));return i.follow(["draft","trial","objects"],()=>{let l=i.get("draft"),c=i.get("objects").get(l?.id??"");if(a.hidden=!l||!c,!l||!c)return;let h=i.get("trial");t.textContent=l.is==="merge"?"Merge":"Split",n.textContent=pw(i,l,c),o.hidden=l.is!=="split",s.textContent=h?.text??(l.is==="merge"&&l.other===null?"":"Asking…"),s.className=h&&!h.isGood?"trouble":"muted",r.textContent=l.is==="merge"?"Merge":"Split",r.setAttribute("aria-label",r.textContent),r.disabled=h?.isGood!==!0}),a}function pw(i,e,t){return e.is==="split"?e.cut.by==="parts"?"Each part that hangs together, for itself.":"What is beyond the plane, for itself.":e.other===null?`Click what shall become a part of ${t.label}.`:`${i.get("objects").get(e.other)?.label??"It"} becomes a part of ${t.label}.`}function mw(i){let e=(h,u,d,f)=>{let p=U("input",{type:"range",aria:{label:h}});return[p.min,p.max,p.step]=[String(u),String(d),String(f)],p.value="0",p.addEventListener("input",()=>o()),p.addEventListener("keydown",v=>v.stopPropagation()),p},t=e("Turn of the plane, degrees",-90,90,5),n=e("Place of the plane, share of the size",-.5,.5,.02),s=(h,u)=>{let d=u.box?Math.hypot(u.box.size_m.x,u.box.size_m.y):1,f=h==="parts"?{by:h}:o0(u,Number(t.value)*Math.PI/180,Number(n.value)*d);i.set("draft",{is:"split",id:u.id,cut:f})},r=()=>{let h=i.get("draft");return h?.is==="split"?i.get("objects").get(h.id)??null:null},o=()=>{let h=r();h&&s("plane",h)},a=ye(null,"Its parts","Each part that hangs together",()=>{let h=r();h&&s("parts",h)}),l=ye(null,"By a plane","What is beyond an upright plane",o),c=U("div",{},U("label",{class:"slider"},U("span",{class:"muted"},"Turn"),t),U("label",{class:"slider"},U("span",{class:"muted"},"Place"),n));return i.follow(["draft"],()=>{let h=i.get("draft"),u=h?.is==="split"&&h.cut.by==="plane";a.setAttribute("aria-pressed",String(!u)),l.setAttribute("aria-pressed",String(u)),c.hidden=!u}),U("div",{},U("div",{class:"buttons"},a,l),c)}var l0=i=>`curl -s '${ag(i)}'`,gw=50051;function c0(i){let[,e,,t]=i.split("/");return["import dhpmap",`m = dhpmap.connect("${location.hostname}:${gw}")["${e}"]  # the server's gRPC address`,`thing = m.objects[${t}]`,"print(thing, thing.center_m, thing.T_map_object)"].join(`
`)}async function h0(i){try{return await navigator.clipboard.writeText(i),!0}catch{return!1}}function u0(i,e,t){let s=i.get("history").filter(r=>r.objects.includes(t.id)).slice(0,6).map(r=>U("li",r.isUndone?{class:"is-undone"}:{},U("span",{},r.what||"edit"),U("span",{class:"muted"},`${r.author||"somebody"} · r${r.revision}`),r.isUndone||!i.get("undoable").includes(r.revision)?null:ye("undo","",`Undo revision ${r.revision}`,()=>{e.undo(r.revision)})));return U("section",{class:"card"},U("h2",{},"Edits"),s.length>0?U("ul",{class:"log"},...s):U("p",{class:"muted"},"Nobody has edited it."))}function d0(i,e,t){let n=(a,l)=>ye(null,a,`Copy: ${l.split(`
`)[0]}…`,()=>{h0(l).then(c=>i.set("toast",c?{text:`${a.replace("Copy as ","")} is in the clipboard`,tone:"plain"}:{text:`The browser does not let the page copy: ${l}`,tone:"problem"}))}),s=ye("hidden","Hide","Hide it (X)",()=>{i.set("hiddenObjects",new Set([...i.get("hiddenObjects"),t.id])),i.set("selected",null)}),r=t.kind==="thing"&&i.get("at")===null,o=ye(null,"Delete","Delete it from the map; can be undone",()=>{e.delete(t)});return o.classList.add("danger"),U("footer",{class:"card actions"},...r?yw(i,e,t):[],n("Copy as curl",l0(t.name)),n("Copy as Python",c0(t.name)),s,r?o:null)}function yw(i,e,t){let n=new C((t.box?.size_m.x??.5)+.1,0,0);return[ye(null,"Clone","A copy beside it; can be undone",()=>{e.clone(t,qo(t.pose,n))}),ye(null,"Merge…","Another thing becomes a part of it; shown before it is done",()=>i.set("draft",{is:"merge",id:t.id,other:null})),ye(null,"Split…","Take it apart; shown before it is done",()=>i.set("draft",{is:"split",id:t.id,cut:{by:"parts"}}))]}var $o=i=>`${Math.round(100*i)} %`,tt=i=>i.toFixed(2),ii=i=>U("dl",{class:"facts"},...i.flatMap(([e,t])=>[U("dt",{},e),U("dd",{},t)]));function Qi(i,e,t,n,s){let r=U("input",{type:"text",value:e,disabled:n,aria:{label:`${i}, ${t}`}});r.inputMode="decimal";let o=t==="m"?.05:15,a=()=>r.value.trim()===""?NaN:Number(r.value.replace(",","."));return r.addEventListener("keydown",l=>{l.stopPropagation();let c={ArrowUp:1,ArrowDown:-1}[l.key];if(c!==void 0&&Number.isFinite(a())&&(r.value=(a()+c*o).toFixed(t==="m"?2:0)),l.key==="Escape"&&r.blur(),l.key!=="Enter")return;let h=a();if(!Number.isFinite(h)){r.value=e,r.select();return}r.blur(),r.value!==e&&s(h)}),U("label",{class:"number"},U("span",{},i),r,U("span",{class:"unit"},t))}function f0(i,e){let t=i.box?.size_m;return ii([["Class",`${i.className}, ${$o(i.classConfidence)} of its views`],["Kind",i.kind==="thing"?"thing":i.kind==="stuff"?"background":"not known"],["Voxels its own",$o(i.instanceConfidence)],["Size",t?`${tt(t.x)} × ${tt(t.y)} × ${tt(t.z)} m`:"—"],["Presence",i.isPresent?i.isConfirmed?"there":"there, seen too little to be sure":"gone"],["Last seen",xw(i,e)],["Seen in",`${i.numFrames} frames`],["Locked",i.isLocked?"robots leave it as it is":"no"],["Id",`#${i.id}, revision ${i.revision}`]])}function xw(i,e){if(i.lastSeen_ns===0n)return"never";let t=Number(e-i.lastSeen_ns)/1e9;return t<.05?"in the newest frame":`${t<120?`${t.toFixed(1)} s`:`${Math.round(t/60)} min`} before the newest frame`}function p0(i,e){let t=i.get("asksNear"),n=i.get("clicked")?.id===e.id?"Nearest to where you clicked":"Nearest to its middle",s=ye(null,t?n:"What is nearest?","Which objects are nearest to it",()=>i.set("asksNear",!t));if(s.setAttribute("aria-expanded",String(t)),!t)return U("section",{class:"card"},s);let r=i.get("near"),a=r?.id===e.id&&r.className===i.get("nearClass")?r.objects.map(({id:c,label:h,distance_m:u})=>U("li",{},ye(null,h,`Select ${h}`,()=>i.set("selected",c)),U("span",{class:"muted"},`${tt(u)} m`))):[U("li",{class:"muted"},"Asking…")],l=U("p",{class:"muted"},"None near.");return U("section",{class:"card near"},U("div",{class:"buttons"},s,_w(i)),a.length>0?U("ul",{class:"log"},...a):l)}function _w(i){let e=[...i.get("objects").values()].filter(({sphere:s})=>s),t=new Set(e.map(({className:s})=>s)),n=U("select",{class:"picker",aria:{label:"Of which class"}},U("option",{value:""},"any thing"),...[...t].sort((s,r)=>s.localeCompare(r,"en")).map(s=>U("option",{value:s},s)));return n.value=i.get("nearClass"),n.addEventListener("change",()=>{n.blur(),i.set("nearClass",n.value)}),n}function m0(i,e,t){let n=i.get("pending"),s=$n(t),r=t.kind!=="thing"||i.get("at")!==null,o=n?.id===t.id?new C(n.pose.translation_m.x-t.pose.translation_m.x,n.pose.translation_m.y-t.pose.translation_m.y,n.pose.translation_m.z-t.pose.translation_m.z):new C,a=c=>Qi(c.toUpperCase(),tt(s[c]+o[c]),"m",r,h=>{e.shift(new C().setComponent("xyz".indexOf(c),h-s[c]))}),l=Qi("Turn by","0","°",r,c=>e.turn(c*Math.PI/180));return U("section",{class:"card pose"},U("h2",{},"Middle, in the map"),U("div",{class:"numbers"},a("x"),a("y"),a("z"),l),U("p",{class:"muted"},i.get("at")!==null?"As it was then.":t.kind==="thing"?"Drag it over the floor, turn it by its ring, or type and press Enter.":"Backgrounds stay where they are."))}function g0(i){let e=i.get("probe");if(!e)return null;let{x:t,y:n,z:s}=e.point_m,{answer:r}=e,o=[["Point",`${tt(t)}, ${tt(n)}, ${tt(s)} m`]],a=i.get("objects").get(e.id);return a&&o.push(["Of",a.label]),r&&(o.push(["Class sure to",$o(r.classConfidence)]),o.push(["Nearest other",r.neighbour??"nothing near"]),r.neighbour&&o.push(["How far",`${tt(r.distance_m)} m`])),U("section",{class:"card probe"},U("h2",{},"Probe"),ii(o),ye("close","","Put the probe away",()=>i.set("probe",null)))}var Gc=class{constructor(e,t,n,s,r){this.store=e;this.edits=t;this.moveTool=n;this.focusOn=s;this.element.append(...r,a0(e,t),this.cardsOfAll),this.toolCards=r,e.follow(["selected","objects","history","pending","probe","undoable","slice_m","tool","path","draft","at","ray","measured_m","clip","near","asksNear","nearClass"],()=>this.draw())}store;edits;moveTool;focusOn;element=U("aside",{class:"panel inspector",aria:{label:"Selection"}});cardsOfAll=U("div");toolCards;draw(){if(this.isBeingTypedIn())return;let e=this.store.get("objects").get(this.store.get("selected")??"");this.element.dataset.id=e?.id??"";let t=g0(this.store);this.element.hidden=!e&&!t&&this.toolCards.every(n=>n.hidden),document.body.classList.toggle("has-inspector",!this.element.hidden),this.cardsOfAll.replaceChildren(...t?[t]:[],...e?this.cards(e):[])}isBeingTypedIn(){let{activeElement:e}=document,t=this.element.dataset.id===(this.store.get("selected")??""),n=e instanceof HTMLInputElement&&e.type!=="range"||e instanceof HTMLSelectElement;return t&&n&&this.cardsOfAll.contains(e)}cards(e){let{store:t,edits:n,moveTool:s}=this,r=0n;for(let{lastSeen_ns:o}of t.get("objects").values())o>r&&(r=o);return[this.head(e),f0(e,r),...[mg(t,n,e)].filter(o=>o!==null),m0(t,s,e),p0(t,e),u0(t,n,e),d0(t,n,e)]}head(e){let{store:t}=this,n=U("span",{class:"swatch large"});n.style.background=pc($i(e));let s=U("input",{class:"title",value:e.label,disabled:t.get("at")!==null,aria:{label:"Name of the object"},title:"Enter renames; empty: the class's name"});return s.addEventListener("keydown",r=>{r.key==="Enter"&&(s.blur(),s.value!==e.label&&this.edits.rename(e,s.value)),r.key==="Escape"&&(s.value=e.label,s.blur()),r.stopPropagation()}),U("header",{class:"card-head"},n,s,ye("frame","","Go there (F)",()=>this.focusOn(e.id)),ye("close","","Let go (Esc)",()=>t.set("selected",null)))}};function Yo(i,e){let t=s=>Math.min(i[s],e[s]),n=s=>Math.max(t(s)+.02,i[s],e[s]);return{min_m:{x:t("x"),y:t("y"),z:t("z")},max_m:{x:n("x"),y:n("y"),z:n("z")}}}function vw(i){let e=null;for(let t of i){let{min_m:n,max_m:s}=e??{min_m:t,max_m:t};e={min_m:{x:Math.min(n.x,t.x),y:Math.min(n.y,t.y),z:Math.min(n.z,t.z)},max_m:{x:Math.max(s.x,t.x),y:Math.max(s.y,t.y),z:Math.max(s.z,t.z)}}}return e}function bw({box:i,sphere:e}){let t=i?.pose.translation_m??e?.center;if(!t)return[];let n=2*(e?.radius_m??0),s=i?.size_m??{x:n,y:n,z:n},r=i?2*Math.atan2(i.pose.rotation.z,i.pose.rotation.w):0,[o,a]=[Math.cos(r),Math.sin(r)];return[-.5,.5].flatMap(l=>[-.5,.5].flatMap(c=>[-.5,.5].map(h=>({x:t.x+l*s.x*o-c*s.y*a,y:t.y+l*s.x*a+c*s.y*o,z:t.z+h*s.z}))))}var jo=i=>vw([...i].flatMap(bw));function Zo({min_m:i,max_m:e},t){return{min_m:{x:i.x-t,y:i.y-t,z:i.z-t},max_m:{x:e.x+t,y:e.y+t,z:e.z+t}}}var Mw=i=>String(Math.round(i*1e3)/1e3),y0=({min_m:i,max_m:e})=>[i.x,i.y,i.z,e.x,e.y,e.z].map(Mw).join(",");function x0(i){let e=(i??"").split(",").map(l=>l===""?NaN:Number(l));if(e.length!==6||!e.every(Number.isFinite))return null;let[t,n,s,r,o,a]=e;return Yo({x:t,y:n,z:s},{x:r,y:o,z:a})}var Sw=["x","y","z"];function Hc(i,e){let t=(n,s)=>{let r=`${s.toUpperCase()} ${n==="min_m"?"from":"to"}`;return Qi(r,tt(i[n][s]),"m",!1,o=>{let a={...i,[n]:{...i[n],[s]:o}};e(Yo(a.min_m,a.max_m))})};return U("div",{class:"numbers"},...Sw.flatMap(n=>[t("min_m",n),t("max_m",n)]))}var ww=3;function _0(i,e){let t=U("div"),n=U("input",{type:"range",aria:{label:"Upper side of the box, m"}}),s=U("span",{class:"muted"}),r=ye(null,"Around the selection","Only what is near the selection",()=>e.aroundSelection());n.addEventListener("input",()=>{let a=i.get("clip");a&&i.set("clip",{...a,max_m:{...a.max_m,z:Number(n.value)}})}),n.addEventListener("keydown",a=>a.stopPropagation());let o=U("section",{class:"card tool"},U("h2",{},"Clip box"),U("label",{class:"slider"},U("span",{class:"muted"},"Up to"),n,s),t,U("div",{class:"buttons"},r),ye("close","","Show all again (C)",()=>i.set("clip",null)));return i.follow(["clip","selected"],()=>{let a=i.get("clip");o.hidden=!a,r.disabled=i.get("selected")===null,a&&([n.min,n.max,n.step]=[String(a.min_m.z+.05),String(a.min_m.z+ww),"0.05"],n.value=String(a.max_m.z),s.textContent=`${tt(a.max_m.z)} m`,t.contains(document.activeElement)||t.replaceChildren(Hc(a,l=>i.set("clip",l))))}),o}var Wc=i=>i.set("slice_m",i.get("slice_m")===null?.4:null);var es=(i,e)=>i.set("tool",i.get("tool")===e?"select":e);var Xc=class{constructor(e){this.values=e}values;followers=new Map;get(e){return this.values[e]}set(e,t){if(!Object.is(this.values[e],t)){this.values[e]=t;for(let n of[...this.followers.get(e)??[]])n()}}follow(e,t){for(let n of e){let s=this.followers.get(n);s||this.followers.set(n,s=new Set),s.add(t)}t()}};var Rr=["sensor","class","object","confidence","last seen","presence"];function gi(i){let e=i.get("map");return e&&{name:e.name,at:i.get("at")}}var v0=()=>new Xc({phase:{is:"connecting"},maps:[],map:null,revision:0,at:null,present:new Map,newest:0,kept:[],showsTime:!1,link:"off",objects:new Map,selected:null,clicked:null,hovered:null,query:"",hiddenClasses:new Set(["ceiling"]),hiddenObjects:new Set,showsGone:!1,colour:"sensor",showsBoxes:!1,theme:"system",camera:null,pending:null,touched:[],robots:[],undoable:[],redoable:[],history:[],toast:null,tool:"select",walks:!1,probe:null,ray:null,asksNear:!1,nearClass:"",near:null,measured_m:[],clip:null,regions:[],regionDraft:null,slice_m:null,path:{points_m:[],radius_m:.2,height_m:.6,seenAlone:!1},pathAnswer:null,draft:null,trial:null,showsHelp:!1});var qc=.05,Tw={ArrowLeft:[-qc,0],ArrowRight:[qc,0],ArrowUp:[0,qc],ArrowDown:[0,-qc]};function b0(i,e,t,n,s){let r=()=>{let l=i.get("selected");l!==null&&(i.set("hiddenObjects",new Set([...i.get("hiddenObjects"),l])),i.set("selected",null))},o=()=>{if(t.isBusy)return t.cancel();if(i.get("draft"))return i.set("draft",null);if(i.get("walks"))return i.set("walks",!1);if(i.get("regionDraft"))return i.set("regionDraft",null);i.get("tool")!=="select"?i.set("tool","select"):i.get("selected")!==null?i.set("selected",null):i.set("query",""),i.set("probe",null),i.set("ray",null),i.set("measured_m",[])},a={"/":s.focusSearch,f:s.focusSelection,h:s.frameAll,Home:s.frameAll,t:s.lookDown,l:s.toggleList,s:()=>Wc(i),b:()=>i.set("showsBoxes",!i.get("showsBoxes")),x:r,Escape:o,p:()=>es(i,"probe"),r:()=>es(i,"path"),d:()=>es(i,"ray"),m:()=>es(i,"measure"),i:()=>es(i,"region"),c:s.toggleClip,g:s.saveScreenshot,w:()=>i.set("walks",!i.get("walks")),"?":()=>i.set("showsHelp",!0),e:()=>i.set("showsTime",!i.get("showsTime")),n:()=>s.showRevision(null),",":()=>{s.stepTime(-1)},".":()=>{s.stepTime(1)},"[":()=>t.turn(Math.PI/12),"]":()=>t.turn(-Math.PI/12)};document.addEventListener("pointerdown",()=>document.body.classList.remove("by-keys"),{capture:!0}),document.addEventListener("keydown",l=>{l.key==="Tab"&&document.body.classList.add("by-keys");let{target:c}=l;if(c instanceof HTMLInputElement&&c.type!=="checkbox"||c instanceof HTMLTextAreaElement||c instanceof HTMLSelectElement||document.querySelector("dialog[open]"))return;if((l.ctrlKey||l.metaKey)&&l.key.toLowerCase()==="z"){l.preventDefault(),l.shiftKey?e.redo():e.undo();return}if(l.ctrlKey||l.metaKey)return;if(n.press(l))return l.preventDefault();let u=l.altKey?Tw[l.key]:void 0,d=Rr[Number(l.key)-1],f=u?()=>t.shift(new C(u[0],u[1],0)):l.altKey?void 0:d?()=>i.set("colour",d):a[l.key.length===1?l.key.toLowerCase():l.key];f&&(l.preventDefault(),f())})}function M0(i){let e=U("div",{class:"label",hidden:!0});return i.follow(["hovered","objects"],()=>{let t=i.get("objects").get(i.get("hovered")??"");e.hidden=!t,t&&e.replaceChildren(t.label,U("span",{class:"muted"},t.isPresent?`#${t.id}`:"gone"))}),e}function S0(i){let e=U("div",{role:"status"}),t=U("section",{class:"card tool"},U("h2",{},"Measure"),e,ye("close","","Put the measure away (M)",()=>{i.set("measured_m",[]),i.get("tool")==="measure"&&i.set("tool","select")}));return i.follow(["measured_m","tool"],()=>{let[n,s]=i.get("measured_m");if(t.hidden=i.get("tool")!=="measure"&&!s,!n||!s)return e.replaceChildren(U("p",{class:"muted"},n?"Click the other end.":"Click a surface."));let[r,o,a]=[s.x-n.x,s.y-n.y,s.z-n.z];e.replaceChildren(ii([["Distance",`${tt(Math.hypot(r,o,a))} m`],["Over the floor",`${tt(Math.hypot(r,o))} m`],["Up",`${tt(a)} m`],["Along X, Y",`${tt(r)}, ${tt(o)} m`]]))}),t}var $c=class{constructor(e,t){this.store=e;this.focusOn=t;let n=U("label",{class:"check",title:"What is kept of objects that are no longer there"},this.goneBox,"Show gone"),s=ye(null,"Show all","Show everything that is hidden",()=>{e.set("hiddenClasses",new Set),e.set("hiddenObjects",new Set)});this.element=U("aside",{class:"panel list",aria:{label:"Objects"}},U("div",{class:"panel-head"},this.search,U("kbd",{},"/")),U("div",{class:"panel-tools"},this.count,n,s),this.rows),this.search.addEventListener("input",()=>e.set("query",this.search.value)),this.search.addEventListener("keydown",r=>this.searchKey(r)),this.goneBox.addEventListener("change",()=>e.set("showsGone",this.goneBox.checked)),this.rows.addEventListener("keydown",r=>this.rowKey(r)),e.follow(["objects","query","hiddenClasses","hiddenObjects","showsGone"],()=>this.ask()),e.follow(["selected"],()=>this.mark()),e.follow(["query"],()=>{this.search.value!==e.get("query")&&(this.search.value=e.get("query"))}),e.follow(["showsGone"],()=>{this.goneBox.checked=e.get("showsGone")})}store;focusOn;element;search=U("input",{type:"search",class:"search",placeholder:"Search objects",aria:{label:"Search objects"}});rows=U("div",{class:"rows"});count=U("span",{class:"count"});goneBox=U("input",{type:"checkbox"});folded=new Set;asked=!1;ask(){this.asked||(this.asked=!0,requestAnimationFrame(()=>{this.asked=!1,this.draw()}))}draw(){let e=document.activeElement instanceof HTMLElement?document.activeElement.dataset.key:void 0,t=ug(this.store.get("objects").values(),this.store.get("query"),this.store.get("showsGone")),n=t.reduce((s,r)=>s+r.objects.length,0);this.count.textContent=`${n} ${n===1?"object":"objects"}`,this.rows.replaceChildren(...t.map(s=>this.group(s))),n===0&&this.rows.append(U("p",{class:"empty"},this.store.get("query")?"Nothing is called that. Esc clears the search.":"No objects yet.")),this.mark(),e&&this.rows.querySelector(`[data-key="${CSS.escape(e)}"]`)?.focus()}group({className:e,objects:t}){let n=t[0],s=this.store.get("hiddenClasses").has(e),r=t.length===1,o=this.folded.has(e)&&this.store.get("query")==="",a=U("div",{class:`class-row${s?" is-hidden":""}`},U("button",{type:"button",class:"class-name",data:{key:`class ${e}`,...r&&n?{id:n.id}:{}},aria:r?{}:{expanded:String(!o)},onClick:()=>r&&n?this.store.set("selected",n.id):this.fold(e)},Aw(n),U("span",{class:"name"},r&&n?n.label:e),r&&n?w0(n):U("span",{class:"count"},String(t.length))),this.eye(`eye ${e}`,s,e,()=>this.store.set("hiddenClasses",pd(this.store.get("hiddenClasses"),e))));return U("section",{class:"class-group"},a,...r||o?[]:t.map(l=>this.row(l)))}row(e){let t={hiddenClasses:this.store.get("hiddenClasses"),hiddenObjects:this.store.get("hiddenObjects"),showsGone:this.store.get("showsGone")},n=U("div",{class:`row${Do(e,t)?"":" is-hidden"}`},U("button",{type:"button",class:"row-name",data:{key:`row ${e.id}`,id:e.id},title:"Click selects, double click goes there",onClick:()=>this.store.set("selected",e.id)},U("span",{class:"name"},e.label),w0(e),e.label.endsWith(e.id)?null:U("span",{class:"id"},`#${e.id}`)),this.eye(`eye ${e.id}`,t.hiddenObjects.has(e.id),e.label,()=>this.store.set("hiddenObjects",pd(this.store.get("hiddenObjects"),e.id))));return n.addEventListener("dblclick",()=>this.focusOn(e.id)),n.addEventListener("pointerenter",()=>this.store.set("hovered",e.id)),n.addEventListener("pointerleave",()=>this.store.set("hovered",null)),n}eye(e,t,n,s){let r=ye(t?"hidden":"eye","",`${t?"Show":"Hide"} ${n}`,s);return r.classList.add("eye"),r.dataset.key=e,r.setAttribute("aria-pressed",String(t)),r}fold(e){this.folded.delete(e)||this.folded.add(e),this.draw()}mark(){let e=this.store.get("selected");for(let t of this.rows.querySelectorAll("[data-id]")){let n=t.dataset.id===e;t.parentElement?.classList.toggle("is-selected",n),t.setAttribute("aria-current",String(n)),n&&t.scrollIntoView({block:"nearest"})}}searchKey(e){if(e.key==="Escape")this.store.set("query",""),this.search.blur();else if(e.key==="Enter"||e.key==="ArrowDown"){this.asked&&this.draw();let t=this.rows.querySelector(".row-name, .class-name[data-id]");t?.focus(),e.key==="Enter"&&t?.click()}else return;e.preventDefault(),e.stopPropagation()}rowKey(e){if(e.key!=="ArrowDown"&&e.key!=="ArrowUp")return;let t=[...this.rows.querySelectorAll(".row-name, .class-name")],n=t.indexOf(document.activeElement),s=t[n+(e.key==="ArrowDown"?1:-1)];s&&(s.focus(),s.dataset.id&&this.store.set("selected",s.dataset.id),e.preventDefault(),e.stopPropagation())}};function w0(i){return i.isPresent?i.isLocked?Oo("lock"):null:U("span",{class:"tag stale"},"gone")}function Aw(i){let e=U("span",{class:"swatch"});return i&&(e.style.background=pc($i(i))),e}async function T0(i){let e={Authorization:`Bearer ${i}`},t=await fetch("/ui/login",{method:"POST",headers:e}).catch(()=>null);if(!t)throw new Xt("the server does not answer",0,"UNREACHABLE");if(!t.ok)throw new Xt("the server knows no such key",t.status,"")}function A0(i){let e=U("input",{class:"search",type:"password",placeholder:"dhp_…",aria:{label:"Key"}});e.autocomplete="current-password";let t=U("p",{class:"said problem",role:"alert"}),n=U("button",{type:"submit",class:"button"},"Open"),s=U("form",{class:"login"},e,n,t);return s.addEventListener("submit",r=>{r.preventDefault(),n.disabled=!0,T0(e.value.trim()).then(i).catch(o=>{t.textContent=o instanceof Error?o.message:String(o),e.select()}).finally(()=>n.disabled=!1)}),s}var Ew=12,Cw=[["Drag","turn about what is under the cursor"],["Right drag, Shift+drag","shift"],["Wheel, pinch","come nearer to what is under the cursor"],["Click","select"],["Double click, F","go there"],["/","search"],["↑ ↓ in the list","next object"],["H","see all"],["T","from above"],["W, then ↑ ↓ ← →","walk through it; a drag looks around, Shift is faster"],["B","boxes"],["1 – 6","colour by sensor, class, object, confidence, last seen, presence"],["X","hide the selection"],["P","probe a point"],["D","a ray: what does it meet first"],["M","measure from one place of a surface to another"],["C","clip box: only what is in it"],["G","save the picture, with the link of the view"],["I","ignored regions: where robots map nothing"],["R","a robot's path: what does it touch first"],["S","slice: occupied, free, unknown at a height"],["E","earlier states of the map, and what has changed since"],[", and .","one state back, one on"],["N","back to now"],["Alt+arrows","move the selection by 5 cm"],["[ ]","turn it by 15°"],["Ctrl+Z, Ctrl+Shift+Z","undo, do again"],["L","list of objects"],["Esc","let go, clear the search"]];function Xd(i,e=()=>{},t=()=>{}){let n=U("div",{class:"overlay",role:"status"});return i.follow(["phase"],()=>{let s=i.get("phase");n.hidden=s.is==="ready";let r=(o,...a)=>n.replaceChildren(U("div",{class:"message"},U("h1",{},o),...a));switch(s.is){case"connecting":return r("Connecting");case"loading":return r("Loading the map",U("p",{class:"muted"},s.bytes>0?`${(s.bytes/1e6).toFixed(1)} MB of surfaces`:"Making its surfaces"),U("div",{class:"progress"}));case"no maps":return r("No map yet",U("p",{},"Feed one, and it appears here while the robot maps:"),U("pre",{},"dhpmap map DATASET_DIR --map office"));case"no such map":return r(`There is no map “${s.id}” here`,U("p",{},"It appears once somebody makes it. These are there:"),U("ul",{class:"choices"},...i.get("maps").slice(0,Ew).map(o=>U("li",{},ye(null,o.displayName,`Open ${o.displayName}`,()=>e(o))))));case"failed":return r("The server does not answer",U("p",{},s.why),U("p",{class:"muted"},"Trying again by itself."));case"locked":return r("This server asks for a key",A0(t),U("p",{class:"muted"},s.why));case"no webgl":return r("This browser shows no 3D",U("p",{},"The viewer needs WebGL 2. Turn on hardware acceleration in the browser's settings, or use another browser."),U("p",{class:"muted"},"The same map as files and JSON: /openapi.json"));case"ready":return n.replaceChildren()}}),n}function E0(i){let e=U("dialog",{class:"help",aria:{label:"Keys"}},U("h1",{},"Keys"),U("dl",{class:"facts keys"},...Cw.flatMap(([t,n])=>[U("dt",{},U("kbd",{},t)),U("dd",{},n)])),U("button",{type:"button",class:"button",onClick:()=>i.set("showsHelp",!1)},"Close"));return e.addEventListener("close",()=>i.set("showsHelp",!1)),i.follow(["showsHelp"],()=>{i.get("showsHelp")&&!e.open&&e.showModal(),!i.get("showsHelp")&&e.open&&e.close()}),e}var Yc=i=>i!==void 0&&i.sphere!==null&&i.isPresent;function Rw(i,e){return i.box&&e.box?[i.box.pose.translation_m,e.box.pose.translation_m]:i.sphere&&e.sphere?[i.sphere.center,e.sphere.center]:[i.pose.translation_m,e.pose.translation_m]}function Pw(i,e){if(Iw(i.pose,e.pose))return"";let[t,n]=Rw(i,e),s=Math.hypot(n.x-t.x,n.y-t.y,n.z-t.z);return s>=.001?`moved by ${s.toFixed(2)} m`:"turned"}function Iw(i,e){let[t,n]=[i.translation_m,e.translation_m],[s,r]=[i.rotation,e.rotation],o=Math.abs(s.x*r.x+s.y*r.y+s.z*r.z+s.w*r.w);return Math.hypot(n.x-t.x,n.y-t.y,n.z-t.z)<.001&&2*Math.acos(Math.min(1,o))<.001}function Lw(i,e){return Yc(i)?!i||!e?"was removed":Yc(e)?[Pw(i,e),i.className!==e.className?`was ${i.className}`:"",i.label!==e.label&&i.className===e.className?`was called ${i.label}`:"",i.isLocked!==e.isLocked?e.isLocked?"locked":"unlocked":""].filter(n=>n!=="").join(", "):"is gone":Yc(e)?i?"is back":"is new":""}function C0(i,e){let t=[],n=0;for(let s of new Set([...i.keys(),...e.keys()])){let[r,o]=[i.get(s),e.get(s)],a=Lw(r,o);a!==""?t.push({id:s,label:o?.label??r?.label??s,what:a}):Yc(o)&&r?.revision!==o?.revision&&++n}return t.sort((s,r)=>s.label.localeCompare(r.label,"en",{numeric:!0})),{named:t,numMapped:n}}var qd=30;function R0(i,e){let t=U("h2"),n=U("ul",{class:"log"}),s=U("p",{class:"muted"}),r=U("section",{class:"card past"},t,n,s,U("div",{class:"buttons"},ye(null,"Back to now","Back to now (N)",e)));return i.follow(["at","objects","present"],()=>{let o=i.get("at");if(r.hidden=o===null,o===null)return;t.textContent=`Since revision ${o}`;let{named:a,numMapped:l}=C0(i.get("objects"),i.get("present"));n.replaceChildren(...a.slice(0,qd).map(({id:c,label:h,what:u})=>{let d=ye(null,h,`Select ${h}`,()=>i.set("selected",c));return d.disabled=!i.get("objects").has(c),U("li",{},d,U("span",{class:"muted"},u))})),s.textContent=Nw(a.length,l)}),r}function Nw(i,e){let t=i>qd?`And ${i-qd} more. `:"";return e>0?`${t}Of ${e===1?"one object":`${e} objects`} more was seen.`:i===0?"Nothing has changed.":t}var $d=i=>typeof i=="number"&&Number.isFinite(i)&&Math.abs(i)<=1e5;function Yd(i,e){let[t,n,s=0]=i;if(!$d(t)||!$d(n)||!$d(s))throw new Error(`${e} is no place: x y, or x y z, in metres`);return{x:t,y:n,z:s}}function Dw(i,e){let t=`waypoint ${e+1}`;if(Array.isArray(i))return Yd(i,t);let n=typeof i=="object"&&i!==null?i:{},s=n.translation_m??n.position??n;return Yd([s.x??0,s.y??0,s.z],t)}function Ow(i){if(Array.isArray(i))return i;let e=i?.waypoints;if(Array.isArray(e))return e;throw new Error("a list of waypoints is wanted")}function jc(i){let e=i.trim(),t=/^[[{]/.test(e)?Ow(Uw(e)).map(Dw):e.split(/[\n;]/).map(n=>n.trim()).filter(n=>n!==""&&!n.startsWith("#")).map((n,s)=>Yd(n.split(/[\s,]+/).map(Number),`line ${s+1}`));if(t.length>1e3)throw new Error("more than 1000 waypoints");return t}function Uw(i){try{return JSON.parse(i)}catch{throw new Error("this is no JSON")}}var Fw=i=>String(Math.round(i*1e3)/1e3),Jo=(i,e=`
`)=>i.map(({x:t,y:n,z:s})=>[t,n,s].map(Fw).join(" ")).join(e),Zc=(i,e=i.length)=>i.slice(1,e).reduce((t,n,s)=>t+Math.hypot(n.x-i[s].x,n.y-i[s].y,n.z-i[s].z),0);var Pr={radius_m:[.03,2],height_m:[.1,3]};function jd(i,e){let t=.06+i,n=Math.max(t,e-i),s=1+Math.ceil((n-t)/i);return Array.from({length:s},(r,o)=>({center_m:{x:0,y:0,z:s===1?t:t+(n-t)*o/(s-1)},radius_m:i}))}function P0(i){let e=U("textarea",{class:"waypoints",aria:{label:"Waypoints: x y z in metres, one a line"}});[e.rows,e.spellcheck]=[3,!1],e.placeholder="Click places on the floor, or paste: x y [z], one a line, or JSON";let t=U("p",{class:"trouble",role:"alert",hidden:!0}),n=U("div",{role:"status"}),s=U("div",{class:"numbers"}),r=U("input",{type:"checkbox"}),o=c=>i.set("path",{...i.get("path"),...c}),a=()=>{try{o({points_m:jc(e.value)}),t.hidden=!0}catch(c){t.textContent=c instanceof Error?c.message:String(c),t.hidden=!1}};e.addEventListener("input",a),e.addEventListener("keydown",c=>{c.stopPropagation(),c.key==="Escape"&&e.blur()}),r.addEventListener("change",()=>o({seenAlone:r.checked}));let l=U("section",{class:"card path"},U("h2",{},"Path of a robot"),e,t,s,U("label",{class:"check"},r,"Keep to what was seen"),n,U("div",{class:"buttons"},ye(null,"Back one","Take the last place away",()=>o({points_m:i.get("path").points_m.slice(0,-1)})),ye(null,"Clear","Take all places away",()=>o({points_m:[]}))),ye("close","","Put the path away",()=>{o({points_m:[]}),i.set("tool","select")}));return i.follow(["path","tool"],()=>{let c=i.get("path");l.hidden=i.get("tool")!=="path"&&c.points_m.length===0,r.checked=c.seenAlone,document.activeElement!==e&&(e.value=Jo(c.points_m),t.hidden=!0),s.contains(document.activeElement)||s.replaceChildren(...Bw(c,o))}),i.follow(["path","pathAnswer","objects"],()=>n.replaceChildren(...kw(i,i.get("pathAnswer")))),l}function Bw(i,e){let t=(n,[s,r])=>Math.min(r,Math.max(s,n));return[Qi("Radius",tt(i.radius_m),"m",!1,n=>e({radius_m:t(n,Pr.radius_m)})),Qi("Height",tt(i.height_m),"m",!1,n=>e({height_m:t(n,Pr.height_m)}))]}function kw(i,e){let{points_m:t}=i.get("path");if(t.length===0)return[];if(!e)return[U("p",{class:"muted"},"Asking…")];let n=h=>{let u=i.get("objects").get(h)?.label??`#${h}`;return ye(null,u,`Select ${u}`,()=>i.set("selected",h))},{contact:s,clearance:r}=e;if(!s){let h=[["Length",`${tt(Zc(t))} m`]];if(r){let u=r.id===null?"":` to ${i.get("objects").get(r.id)?.label??r.id}`;h.push(["Nearest",`${tt(r.distance_m)} m${u}`])}return[U("p",{class:"good"},"Free to go"),ii(h)]}let o=t[s.waypoint],a=t[s.waypoint+1],l=o&&a?s.fraction*Zc([o,a]):0,c=Zc(t,s.waypoint+1)+l;return[U("p",{class:"collision"},c<.005?"Where it starts it touches ":`After ${tt(c)} m it touches `,s.id===null?"what nobody has seen":n(s.id))]}function I0(i,e){let t=U("div",{role:"status"}),n=ye(null,"Along the view","From the eye, straight ahead",()=>e.alongTheView()),s=U("section",{class:"card tool"},U("h2",{},"Ray"),t,U("div",{class:"buttons"},n),ye("close","","Put the ray away (D)",()=>{i.set("ray",null),i.get("tool")==="ray"&&i.set("tool","select")}));return i.follow(["ray","tool","objects"],()=>{s.hidden=i.get("tool")!=="ray"&&i.get("ray")===null,t.replaceChildren(...zw(i))}),s}function zw(i){let e=i.get("ray");if(!e)return[U("p",{class:"muted"},"Click where it begins, then what it goes through.")];let{answer:t}=e;if(!t)return[U("p",{class:"muted"},"Asking…")];let n=[["Free for",`${tt(t.free_m)} m`],["Then",t.isSeen?t.point_m?"a surface":"nothing, as far as one asks":"what nobody has seen"]];if(!t.point_m)return[U("p",{},"It meets nothing"),ii(n)];let s=i.get("objects").get(t.id??"")?.label??"what is not known",{id:r}=t;return[U("p",{},`After ${tt(t.distance_m)} m it meets `,r===null?s:ye(null,s,`Select ${s}`,()=>i.set("selected",r))),ii(n)]}function L0(i,e,t){let n=U("div"),s=U("input",{type:"text",aria:{label:"Name of the region"}}),r=U("input",{type:"checkbox"}),o=p=>{let v=i.get("regionDraft");v&&i.set("regionDraft",{...v,...p})};s.addEventListener("input",()=>o({name:s.value.trim()})),s.addEventListener("keydown",p=>{p.stopPropagation(),(p.key==="Escape"||p.key==="Enter")&&s.blur()}),r.addEventListener("change",()=>o({clears:r.checked}));let a=ye(null,"Keep it clear","From now on robots map nothing there; can be undone",()=>{let p=i.get("regionDraft");p&&e.ignore(p)}),l=ye(null,"Cancel","Leave it (Esc)",()=>i.set("regionDraft",null)),c=U("div",{},U("label",{class:"number"},U("span",{},"Name"),s),n,U("label",{class:"check"},r,"Clear what is there now, too"),U("div",{class:"buttons"},a,l)),h=ye(null,"Around the selection","A box around what is selected, or in the middle",()=>t.around()),u=U("div",{},U("p",{class:"muted"},"Robots map nothing in an ignored region: a door that swings, a screen."),U("p",{class:"muted"},"Click two corners on the floor, or:"),U("div",{class:"buttons"},h)),d=U("ul",{class:"log"}),f=U("section",{class:"card tool region"},U("h2",{},"Ignored regions"),u,c,d,ye("close","","Put the regions away (I)",()=>i.set("tool","select")));return i.follow(["tool","regionDraft","regions","at"],()=>{let p=i.get("regionDraft");f.hidden=i.get("tool")!=="region",u.hidden=p!==null,c.hidden=p===null,a.disabled=i.get("at")!==null||p?.name==="",d.replaceChildren(...i.get("regions").map(v=>Vw(i,e,v.name))),p&&(document.activeElement!==s&&(s.value=p.name),r.checked=p.clears,n.contains(document.activeElement)||n.replaceChildren(Hc(p.box,v=>o({box:v}))))}),f}function Vw(i,e,t){let n=ye(null,"Lift",`Robots map in ${t} again; can be undone`,()=>{e.lift(t)});return n.disabled=i.get("at")!==null,U("li",{},U("span",{},t),U("span",{class:"gap"}),n)}function N0(i){let e=U("input",{type:"range",aria:{label:"Height of the slice, m"}});[e.min,e.max,e.step]=["-0.5","3","0.05"];let t=U("span",{class:"muted"});e.addEventListener("input",()=>i.set("slice_m",Number(e.value))),e.addEventListener("keydown",r=>r.stopPropagation());let n=(r,o)=>U("span",{class:`legend ${r}`},o),s=U("section",{class:"card slice"},U("h2",{},"Slice"),U("div",{class:"slider"},e,t),U("p",{},n("occupied","occupied"),n("free","free"),n("unknown","unknown")),ye("close","","Put the slice away (S)",()=>i.set("slice_m",null)));return i.follow(["slice_m"],()=>{let r=i.get("slice_m");s.hidden=r===null,r!==null&&(e.value=String(r),t.textContent=`${tt(r)} m`)}),s}var Gw=9e3,Hw={confidence:"Amber: its class is not certain. Grey: nearly all views agree.","last seen":"Amber: not seen for the longest. Grey: seen last.",presence:"Amber: gone, or not known. Grey: there."},Ww={ray:"Click where the ray begins, then what it goes through. D ends it.",measure:"Click one end on a surface, then the other. M ends it.",region:"Click one corner on the floor, then the opposite one. I ends it."},Jc=class{constructor(e,t,n){this.store=e;this.renderer=t;this.edits=n;this.element=U("footer",{class:"status"},this.said,U("span",{class:"gap"}),this.amount),e.follow(["toast","tool","selected","link","colour","touched","draft","walks","at"],()=>this.say()),e.follow(["objects","phase","showsGone","robots"],()=>this.count())}store;renderer;edits;element;said=U("span",{class:"said",role:"status"});amount=U("span",{class:"amount"});timer=0;count(){let e=this.renderer.numTriangles,t=this.store.get("robots").filter(({isFeeding:s})=>s).length,n=t===0?"":`${t===1?"a robot maps":`${t} robots map`} · `;this.amount.textContent=e===0?"":`${n}${hg(this.store.get("objects").values(),this.store.get("showsGone"))} objects · ${Math.round(e/1e3)} k triangles · ${(this.renderer.meshBytes/1e6).toFixed(1)} MB`}say(){let e=this.store.get("touched");if(e.length>0){let s=e.slice(0,4).map(r=>this.store.get("objects").get(r)?.label??`#${r}`);this.said.className="said collision",this.said.replaceChildren(`It would touch ${s.join(", ")}${e.length>4?" and more":""}`);return}let t=this.store.get("toast");if(clearTimeout(this.timer),this.said.className=`said ${t?.tone??""}`,!t){this.said.replaceChildren(this.hint());return}let n=this.store.get("at")===null?t.undoRevision:void 0;this.said.replaceChildren(t.text,...n===void 0?[]:[ye("undo","Undo",`Undo: ${fi(this.store,n)}`,()=>{this.edits.undo(n)})]),this.timer=window.setTimeout(()=>this.store.set("toast",null),Gw)}hint(){if(this.store.get("link")==="lost")return"The server does not answer. What is shown is as it was; it goes on by itself.";if(this.store.get("at")!==null&&this.store.get("tool")==="select")return"This is how it was; look and ask, nothing can be changed. , and . go back and on, N back to now.";if(this.store.get("tool")==="probe")return"Click a point: what is there, how far is the nearest surface. P ends it.";if(this.store.get("walks"))return"Arrow keys walk, Shift faster, a drag looks around. W or Esc goes back up.";if(this.store.get("tool")==="path")return"Click places on the floor: the robot goes from one to the next. R ends it.";let e=Ww[this.store.get("tool")];if(e)return e;if(this.store.get("draft")?.is==="merge")return"Click what shall become a part of it. Esc leaves it.";let t=Hw[this.store.get("colour")];return t||(this.store.get("selected")!==null?"Drag it to move it, its ring to turn it. F goes there, X hides it, Esc lets go.":"Drag to turn, right drag to shift, wheel to come nearer. Click an object. / searches, ? has all keys.")}};var D0=i=>new Date(i).toLocaleTimeString("en-GB");function Xw(i,e){let t=Math.max(0,(e-i)/1e3);return t<100?`${Math.round(t)} s`:t<6e3?`${Math.round(t/60)} min`:`${Math.round(t/3600)} h`}function O0(i,e){let t=U("input",{type:"range",aria:{label:"State of the map"}});[t.min,t.step]=["0","1"];let n=U("span",{class:"when",role:"status"}),s=ye(null,"‹","The state before (,)",()=>{e.step(-1)}),r=ye(null,"›","The state after (.)",()=>{e.step(1)}),o=ye(null,"Now","Back to now (N)",()=>e.show(null)),a=ye("close","","Put the timeline away (E)",()=>{e.show(null),i.set("showsTime",!1)}),l=U("section",{class:"timeline",aria:{label:"Time"}},s,t,r,n,o,a);return t.addEventListener("input",()=>{let c=i.get("kept"),h=c[c.length-1-Number(t.value)];h&&e.show(h===c[0]?null:h.revision)}),i.follow(["showsTime","at","kept","history","newest"],()=>{let[c,h]=[i.get("at"),i.get("kept")];l.hidden=!i.get("showsTime"),document.body.classList.toggle("has-timeline",!l.hidden),l.classList.toggle("is-past",c!==null);let u=c===null?0:h.findIndex(({revision:d})=>d===c);t.max=String(Math.max(0,h.length-1)),u>=0&&(t.value=String(h.length-1-u)),t.disabled=h.length<2,s.disabled=u===h.length-1,r.disabled=o.disabled=c===null,n.textContent=qw(i,u),t.setAttribute("aria-valuetext",n.textContent)}),l}function qw(i,e){let[t,n]=[i.get("at"),i.get("kept")];if(t===null){let o=n.at(-1);return o&&n.length>1?`Now. ${n.length-1} earlier states are kept, back to ${D0(o.time_ms)}`:"Now. No earlier state is kept: the server keeps the last ones of a map while it is open"}let s=n[e];if(!s)return`Revision ${t} is no longer kept: what you see is all that is left of it`;let r=i.get("history").some(({revision:o})=>o===t)?` · after ${fi(i,t)}`:"";return`${D0(s.time_ms)}, ${Xw(s.time_ms,Date.now())} ago · revision ${t}${r}`}var $w=[["probe","probe","Probe (P): what is at a point, how far is the nearest surface"],["ray","ray","Ray (D): what does it meet first"],["measure","measure","Measure (M): from one place to another"],["path","path","Path (R): can a robot go there, and what does it touch first"],["region","region","Ignored regions (I): where robots map nothing"]],Yw={system:"dark",dark:"light",light:"system"},Kc=class{constructor(e,t,n){this.store=e;let s=U("span",{class:"link",role:"status"}),r=U("span",{class:"revision"}),o=ye("undo","","Undo",()=>{t.undo()}),a=ye("redo","","Do again",()=>{t.redo()}),l=ye("box","","Boxes (B)",()=>e.set("showsBoxes",!e.get("showsBoxes"))),c=$w.map(([m,g,x])=>{let b=ye(g,"",x,()=>es(e,m));return e.follow(["tool"],()=>b.setAttribute("aria-pressed",String(e.get("tool")===m))),b}),h=ye("clip","","Clip box (C): only what is in it",n.toggleClip),u=ye("camera","","Save the picture (G), with the link of the view",n.saveScreenshot),d=ye("slice","","Slice (S): occupied, free and unknown at a height",()=>Wc(e)),f=ye("walk","","Walk (W): at the height of the eyes, by arrow keys",()=>e.set("walks",!e.get("walks"))),p=ye("clock","","Earlier states (E), and what has changed since",()=>e.set("showsTime",!e.get("showsTime"))),v=ye("theme","","Dark, light or as the system",()=>e.set("theme",Yw[e.get("theme")]));this.element=U("header",{class:"top"},ye("list","","Objects (L)",n.toggleList),U("span",{class:"brand"},jw(),"DHP"),this.mapPicker(n),s,r,U("span",{class:"gap"}),this.colourPicker(),U("span",{class:"group"},ye("frame","","See all (H)",n.frameAll),ye("top","","From above (T)",n.lookDown),f,l,d,h,p,u),U("span",{class:"group"},...c),U("span",{class:"group"},o,a),U("span",{class:"group"},v,ye("help","","Keys (?)",()=>e.set("showsHelp",!0)))),e.follow(["link","phase"],()=>{let m={live:"live",lost:"link lost, trying again",off:"connecting"};s.dataset.link=e.get("link"),s.textContent=e.get("phase").is==="locked"?"asks for a key":m[e.get("link")]}),e.follow(["revision","at"],()=>{let m=e.get("at")===null?"":", in the past";r.textContent=e.get("revision")>0?`revision ${e.get("revision")}${m}`:"",r.classList.toggle("is-past",m!=="")}),e.follow(["showsBoxes","slice_m","walks","showsTime","clip"],()=>{p.setAttribute("aria-pressed",String(e.get("showsTime"))),f.setAttribute("aria-pressed",String(e.get("walks"))),d.setAttribute("aria-pressed",String(e.get("slice_m")!==null)),l.setAttribute("aria-pressed",String(e.get("showsBoxes"))),h.setAttribute("aria-pressed",String(e.get("clip")!==null))}),e.follow(["undoable","redoable","history","at"],()=>{let m=e.get("undoable").at(-1),g=e.get("redoable").at(-1);o.disabled=m===void 0||e.get("at")!==null,a.disabled=g===void 0||e.get("at")!==null,o.title=m===void 0?"Nothing to undo":`Undo: ${fi(e,m)} (Ctrl+Z)`,a.title=g===void 0?"Nothing to do again":`Do again: ${fi(e,g)} (Ctrl+Shift+Z)`})}store;element;mapPicker(e){let t=U("select",{class:"picker",aria:{label:"Map"}});return t.addEventListener("change",()=>{let n=this.store.get("maps").find(s=>s.id===t.value);n&&e.openMap(n)}),this.store.follow(["maps","map"],()=>{t.replaceChildren(...this.store.get("maps").map(n=>U("option",{value:n.id},n.displayName))),t.value=this.store.get("map")?.id??"",t.hidden=this.store.get("maps").length===0}),t}colourPicker(){let e=U("select",{class:"picker",aria:{label:"Colour by"}},...Rr.map(t=>U("option",{value:t},t)));return e.addEventListener("change",()=>this.store.set("colour",e.value)),this.store.follow(["colour"],()=>{e.value=this.store.get("colour")}),U("label",{class:"labelled"},U("span",{},"Colour"),e)}},jw=()=>Oo("box");var Zw=[.075,.323,1],Jw=[1,.102,.114];function Kw(i,e,t){let n=Number(t-e);return n>0?Number(t-i.lastSeen_ns)/n:0}function Qw(i){let e=null,t=null;for(let{lastSeen_ns:n,kind:s}of i)s==="unknown"||n===0n||((e===null||n<e)&&(e=n),(t===null||n>t)&&(t=n));return[e??0n,t??0n]}var Qc=class{constructor(e,t){this.store=e;this.renderer=t;e.follow(["objects","hiddenClasses","hiddenObjects","showsGone","colour","query"],()=>this.look()),e.follow(["pending","objects"],()=>this.place()),e.follow(["selected","hovered"],()=>this.point()),e.follow(["showsBoxes","selected","objects","pending","touched","touched","hiddenClasses","hiddenObjects","showsGone"],()=>this.box())}store;renderer;refresh(){this.look(),this.place(),this.point()}poseOf(e){let t=this.store.get("pending");return t?.id===e.id?t.pose:e.pose}look(){let e=this.store.get("objects"),[t,n]=Qw(e.values()),s=this.store.get("query"),r={hiddenClasses:this.store.get("hiddenClasses"),hiddenObjects:this.store.get("hiddenObjects"),showsGone:this.store.get("showsGone")};for(let o of this.renderer.allMeshes()){let a=e.get(o.id);if(o.mesh.visible=a!==void 0&&Do(a,r),!a||!o.mesh.visible)continue;let l=s!==""&&!fd(a,s)?1:a.isPresent?0:.4;o.setLook(pg(this.store.get("colour"),a,Kw(a,t,n)),l)}this.renderer.unseen.show(e.values()),this.renderer.frames.invalidate()}place(){let e=this.store.get("objects");for(let t of this.renderer.allMeshes()){let n=e.get(t.id);n&&t.setPose(this.poseOf(n))}this.renderer.frames.invalidate()}point(){let e=t=>{let n=this.renderer.meshOf(t);return n?.mesh.visible?n:null};this.renderer.selected=e(this.store.get("selected")),this.renderer.hovered=e(this.store.get("hovered")),this.renderer.frames.invalidate()}box(){let e=this.store.get("selected"),t=this.store.get("pending"),n={hiddenClasses:this.store.get("hiddenClasses"),hiddenObjects:this.store.get("hiddenObjects"),showsGone:this.store.get("showsGone")},s=this.store.get("touched").length>0,r=[];for(let o of this.store.get("objects").values()){let a=o.id===e,l=this.store.get("showsBoxes")&&o.kind==="thing"&&Do(o,n);if(!a&&!l)continue;let c=t?.id===o.id?Zd(o.pose,t.pose):null;r.push({object:o,colour:a?s?Jw:Zw:$i(o),T_moved:c})}this.renderer.boxes.show(r),this.renderer.setTouching(s),this.renderer.frames.invalidate()}},Zd=(i,e)=>Un(e).multiply(Un(i).invert());var eT=(()=>{let i=[];for(let e=0;e<3;++e)for(let t of[-1,1])for(let n of[-1,1])for(let s of[-1,1]){let r=[0,0,0];r[e]=s,r[(e+1)%3]=t,r[(e+2)%3]=n,i.push(r)}return i})(),eh=class{lines=new Pn(new rt,new xn({vertexColors:!0,transparent:!0,opacity:.85}));constructor(){this.lines.frustumCulled=!1}show(e){let t=[],n=[];for(let{object:s,colour:r,T_moved:o}of e){if(!s.box)continue;let a=Un(s.box.pose);o&&a.premultiply(o);let{x:l,y:c,z:h}=s.box.size_m;for(let[u,d,f]of eT){let p=new C(.5*u*l,.5*d*c,.5*f*h).applyMatrix4(a);t.push(p.x,p.y,p.z),n.push(...r)}}this.lines.geometry.dispose(),this.lines.geometry=new rt,this.lines.geometry.setAttribute("position",new Qe(new Float32Array(t),3)),this.lines.geometry.setAttribute("color",new Qe(new Float32Array(n),3)),this.lines.visible=t.length>0}};var Jd=new C(0,0,1),Ir=ei.degToRad(89.9),tT=350,Kd=.0055;function Ko(i,e){return new C(Math.cos(e)*Math.cos(i),Math.cos(e)*Math.sin(i),Math.sin(e))}var th=class{constructor(e,t){this.frames=e;this.onMoved=t;this.apply()}frames;onMoved;three=new fn(50,1,.05,400);yaw=0;pitch=0;covered_px=0;height_px=1;flight=null;get view(){let{x:e,y:t,z:n}=this.three.position;return{position_m:{x:e,y:t,z:n},yaw:this.yaw,pitch:this.pitch}}setView(e){this.three.position.set(e.position_m.x,e.position_m.y,e.position_m.z),this.yaw=e.yaw,this.pitch=ei.clamp(e.pitch,-Ir,Ir),this.apply()}resize(e,t,n){this.height_px=Math.max(1,t),this.three.aspect=e/this.height_px,this.three.setViewOffset(e,t,-n/2,0,e,t),this.three.updateProjectionMatrix(),this.frames.invalidate()}rayAt(e){let t=this.three.position.clone();return new Kn(t,new C(e.x,e.y,.5).unproject(this.three).sub(t).normalize())}orbit(e,t,n){this.stopFlight();let s=Ko(this.yaw,this.pitch),r=new C().crossVectors(s,Jd).normalize(),o=ei.clamp(this.pitch-n*Kd,-Ir,Ir),a=new jt().setFromAxisAngle(r,o-this.pitch),l=new jt().setFromAxisAngle(Jd,-t*Kd),c=this.three.position.clone().sub(e).applyQuaternion(a).applyQuaternion(l);this.three.position.copy(e).add(c),this.yaw-=t*Kd,this.pitch=o,this.apply()}look(e,t){this.stopFlight();let n=2*Math.tan(ei.degToRad(this.three.fov/2))/this.height_px;this.yaw+=e*n,this.pitch=ei.clamp(this.pitch+t*n,-Ir,Ir),this.apply()}walk(e,t){this.stopFlight();let[n,s]=[Math.sin(this.yaw),Math.cos(this.yaw)];this.three.position.x+=e*s+t*n,this.three.position.y+=e*n-t*s,this.apply()}pan(e,t,n){this.stopFlight();let s=e.clone().sub(this.three.position).dot(Ko(this.yaw,this.pitch)),r=o=>{let a=this.rayAt(o);return a.at(Math.max(.2,s)/a.direction.dot(Ko(this.yaw,this.pitch)),new C)};this.three.position.add(r(t).sub(r(n))),this.apply()}zoom(e,t){this.stopFlight();let n=this.three.position.clone().sub(e),s=ei.clamp(n.length()*1.0015**t,.15,150);this.three.position.copy(e).add(n.setLength(s)),this.apply()}frame(e,t,n,s){let{yaw:r,pitch:o}=n??this,a=ei.degToRad(this.three.fov/2),l=Math.min(a,Math.atan(Math.tan(a)*this.three.aspect)),c=Math.max(t,.15)/Math.sin(l),h=Ko(r,o),u=new C(Math.sin(r),-Math.cos(r),0),d=this.covered_px/2*2*c*Math.tan(a)/this.height_px,f=e.clone().addScaledVector(h,-c).addScaledVector(u,d);this.flyTo({position_m:f,yaw:r,pitch:o},s)}flyTo(e,t){if(this.stopFlight(),t||matchMedia("(prefers-reduced-motion: reduce)").matches)return this.setView(e);let n=this.view,s=performance.now(),r=ei.euclideanModulo(e.yaw-n.yaw+Math.PI,2*Math.PI)-Math.PI;this.flight=o=>{let a=ei.clamp((o-s)/tT,0,1),l=1-(1-a)**3,c=(h,u)=>h+(u-h)*l;return this.setView({position_m:{x:c(n.position_m.x,e.position_m.x),y:c(n.position_m.y,e.position_m.y),z:c(n.position_m.z,e.position_m.z)},yaw:n.yaw+r*l,pitch:c(n.pitch,e.pitch)}),a<1},this.frames.animate(this.flight)}stopFlight(){this.flight&&this.frames.stop(this.flight),this.flight=null}apply(){let e=Ko(this.yaw,this.pitch);this.three.up.copy(Jd),this.three.lookAt(this.three.position.clone().add(e)),this.three.updateMatrixWorld(),this.onMoved(),this.frames.invalidate()}};var nh=class{constructor(e){this.draw=e}draw;drawn=0;asked=!1;asked_ms=0;movers=new Set;get isIdle(){return!this.asked&&this.movers.size===0}invalidate(){this.asked||(this.asked=!0,this.asked_ms=performance.now(),requestAnimationFrame(e=>{this.asked=!1;for(let t of[...this.movers])t(e)||this.movers.delete(t);this.draw(performance.now()-this.asked_ms),++this.drawn,this.movers.size>0&&this.invalidate()}))}animate(e){this.movers.add(e),this.invalidate()}stop(e){this.movers.delete(e)}};var U0=[.7,1.4,2,2.8,4,5.6,8,11,16,22,32,45,64],nT=({object:i,pixelsPerMetre:e},t)=>{let n=0;for(;n+1<r0&&i.errorOf_m(n+1)*e<=t;)++n;return n};function iT(i,e){let t=a=>i.map(l=>nT(l,a)),n=a=>i.reduce((l,{object:c},h)=>l+c.trianglesOf(a[h]??0),0),s=U0.map(t).find(a=>n(a)<=e)??t(1/0),r=e-n(s);if(!Number.isFinite(r))return s;let o=i.map((a,l)=>l).sort((a,l)=>i[a].object.numTriangles-i[l].object.numTriangles);for(let a of o){let{object:l}=i[a];for(let c=s[a]??0;c>0;s[a]=--c){let h=l.trianglesOf(c-1)-l.trianglesOf(c);if(h>r||l.errorOf_m(c)*i[a].pixelsPerMetre<=U0[0])break;r-=h}}return s}function F0(i,e,t,n){let s=t/(2*Math.tan(e.fov*Math.PI/360)),r=[];for(let a of i){if(!a.mesh.visible)continue;a.mesh.updateMatrixWorld();let l=new Wt().copy(a.mesh.geometry.boundingSphere).applyMatrix4(a.mesh.matrixWorld),c=Math.max(.5,l.center.distanceTo(e.position)-.7*l.radius);r.push({object:a,pixelsPerMetre:s/c})}let o=iT(r,n);r.forEach(({object:a},l)=>a.mesh.geometry=a.geometryOf(o[l]??0))}function B0(i){for(let e of i)e.mesh.geometry=e.geometryOf(0)}var sT="varying vec2 at; void main() { at = uv; gl_Position = vec4(position.xy, 0.0, 1.0); }",rT=`
  uniform sampler2D mask;
  uniform vec2 step_;
  uniform vec3 selected;
  uniform vec3 hovered;
  varying vec2 at;
  void main() {
    vec2 here = texture2D(mask, at).rg;
    vec2 around = vec2(0.0);
    for (int i = 0; i < 8; ++i) {
      float angle = 0.7853981 * float(i);
      around = max(around, texture2D(mask, at + step_ * vec2(cos(angle), sin(angle))).rg);
    }
    vec2 edge = clamp(around - here, 0.0, 1.0);
    vec3 shown = mix(hovered, selected, step(edge.g, edge.r));
    float cover = max(edge.r, 0.75 * edge.g);
    // A breath of colour inside says which it is where its edge is hidden.
    float inside = here.r * 0.10;
    gl_FragColor = vec4(mix(selected, shown, step(0.001, cover)), max(cover, inside));
  }`,ih=class{target=new gn(1,1,{type:vn,depthBuffer:!1});scene=new zi;screen=new zi;flat=new tr(-1,1,1,-1,0,1);red=new Ft({color:new De(1,0,0),depthTest:!1});green=new Ft({color:new De(0,1,0),depthTest:!1});material=new on({uniforms:{mask:{value:this.target.texture},step_:{value:new _e},selected:{value:new De("#4C9AFF")},hovered:{value:new De("#E6E9EF")}},vertexShader:sT,fragmentShader:rT+`
`,transparent:!0,depthTest:!1,depthWrite:!1});constructor(){let e=new Ke(new In(2,2),this.material);e.frustumCulled=!1,this.screen.add(e)}setClip(e){let t=e&&[0,1,2].flatMap(n=>{let s=new C().setComponent(n,1);return[new St(s,-e.min.getComponent(n)),new St(s.clone().negate(),e.max.getComponent(n))]});for(let n of[this.red,this.green])n.clippingPlanes=t,n.needsUpdate=!0}setHoverColour(e){this.material.uniforms.hovered.value.set(e)}setSelectionColour(e){this.material.uniforms.selected.value.set(e)}draw(e,t,n,s){if(this.scene.clear(),s&&s!==n&&this.add(s,this.green),n&&this.add(n,this.red),this.scene.children.length===0)return;let r=e.getDrawingBufferSize(new _e);this.target.setSize(r.x,r.y);let o=Math.max(1.2,1.6*e.getPixelRatio());this.material.uniforms.step_.value.set(o/r.x,o/r.y);let a=e.getClearAlpha();e.setRenderTarget(this.target),e.setClearAlpha(0),e.clear(),e.render(this.scene,t),e.setClearAlpha(a),e.setRenderTarget(null),e.render(this.screen,this.flat)}add(e,t){let n=new Ke(e.mesh.geometry,t);n.matrixAutoUpdate=!1,n.matrix.copy(e.mesh.matrix),this.scene.add(n)}};var k0=[{mostTriangles:1/0,pixelShare:1},{mostTriangles:1e6,pixelShare:1},{mostTriangles:3e5,pixelShare:.75},{mostTriangles:14e4,pixelShare:.7},{mostTriangles:6e4,pixelShare:.6},{mostTriangles:25e3,pixelShare:.5}],oT=4,sh=class{level;numSlow=0;numFast=0;constructor(e){this.level=e?oT:0}get detail(){return k0[this.level]}drew(e){return this.numFast=e<24?this.numFast+1:0,this.numSlow=e>90?this.numSlow+1:0,this.numSlow<2||this.level+1===k0.length?!1:(this.numSlow=0,++this.level,!0)}rests(){this.numFast>=12&&this.level>0&&--this.level,this.numFast=this.numSlow=0}};function z0(i){let e=i.getExtension("WEBGL_debug_renderer_info"),t=String(i.getParameter(e?e.UNMASKED_RENDERER_WEBGL:i.RENDERER));return/swiftshader|llvmpipe|softpipe|software|basic render/i.test(t)}var aT="varying vec2 at_m; void main() { at_m = position.xy; gl_Position = projectionMatrix * viewMatrix * vec4(position, 1.0); }",lT=`
  uniform vec3 dark;
  uniform vec3 stripe;
  varying vec2 at_m;
  void main() {
    float along = (at_m.x + at_m.y) * 4.0;
    float width = clamp(fwidth(along), 0.001, 1.0);
    float line = smoothstep(0.16 + width, 0.16, abs(fract(along) - 0.5)) * (1.0 - smoothstep(0.4, 1.0, width));
    gl_FragColor = vec4(mix(dark, stripe, line), 1.0);
    #include <colorspace_fragment>
  }`,rh=class{mesh=new Ke(new rt,new on({uniforms:{dark:{value:new De},stripe:{value:new De}},vertexShader:aT,fragmentShader:lT,side:wt}));shown="";constructor(){this.mesh.frustumCulled=!1}setColours(e,t){this.mesh.material.uniforms.dark.value.set(e),this.mesh.material.uniforms.stripe.value.set(t)}show(e){let t=V0(e),n=t?`${t.footprint_m.map(o=>o.toFixed(1)).join(",")} ${Qd(t).toFixed(1)}`:"";if(n===this.shown||(this.shown=n,this.mesh.geometry.dispose(),this.mesh.geometry=new rt,this.mesh.visible=t!==null,!t))return;let s=G0(t),r=Qd(t)-.05;this.mesh.geometry.setAttribute("position",new Qe(new Float32Array(s.flatMap(({x:o,y:a})=>[o,a,r])),3)),this.mesh.geometry.setIndex(er.triangulateShape(s,[]).flat())}};function V0(i){let e=null,t=0;for(let n of i){if(n.kind!=="stuff")continue;let s=Math.abs(er.area(G0(n)));s>t&&([e,t]=[n,s])}return e}function Lr(i){let e=V0(i);return e?Qd(e):0}var G0=({footprint_m:i})=>i.flatMap((e,t)=>t%2===0?[new _e(e,i[t+1]??0)]:[]),Qd=({box:i})=>i?i.pose.translation_m.z-i.size_m.z/2:0;var Nr=1e9,cT={min_m:{x:-Nr,y:-Nr,z:-Nr},max_m:{x:Nr,y:Nr,z:Nr}};function H0(i){let{min_m:e,max_m:t}=i??cT;return Ii.min.value.set(e.x,e.y,e.z),Ii.max.value.set(t.x,t.y,t.z),i&&new st(Ii.min.value,Ii.max.value)}function W0({origin:i,direction:e}){let[t,n]=[0,1/0];for(let s of["x","y","z"]){if(e[s]===0)continue;let r=a=>(a[s]-i[s])/e[s],o=[r(Ii.min.value),r(Ii.max.value)];t=Math.max(t,Math.min(...o)),n=Math.min(n,Math.max(...o))}return t<n?[t,n]:null}var hT=180,uT=400,oh=class{constructor(e){this.onCameraMoved=e;this.three=new tc({antialias:!0,powerPreference:"high-performance"}),this.canvas=this.three.domElement,this.isWithoutGpu=z0(this.three.getContext()),this.pace=new sh(this.isWithoutGpu),this.three.autoClear=!1,this.three.localClippingEnabled=!0,this.camera=new th(this.frames,()=>this.cameraMoved()),this.raycaster.firstHitOnly=!0,this.grid.rotation.x=Math.PI/2,this.grid.position.z=-.08;let t=this.grid.material;t.vertexColors=!1,t.transparent=!0,t.opacity=.5,this.scene.add(this.grid,this.unseen.mesh,this.surfaces,this.boxes.lines)}onCameraMoved;canvas;frames=new nh(e=>this.draw(e));camera;boxes=new eh;unseen=new rh;tools=new rn;selected=null;hovered=null;objects=new Map;scene=new zi;surfaces=new rn;three;outline=new ih;grid=new _o(60,60);raycaster=new xo;isWithoutGpu;pace;numCalls=0;numDrawnTriangles=0;isMoving=!1;restTimer=0;get isResting(){return!this.isMoving&&this.frames.isIdle}get drawCalls(){return this.numCalls}get drawnTriangles(){return this.numDrawnTriangles}get geometries(){return this.three.info.memory.geometries}get numTriangles(){return[...this.objects.values()].reduce((e,t)=>e+t.numTriangles,0)}get meshBytes(){return[...this.objects.values()].reduce((e,t)=>e+t.bytes,0)}meshOf(e){return e===null?null:this.objects.get(e)??null}allMeshes(){return this.objects.values()}addToScene(e){this.scene.add(e),this.frames.invalidate()}put(e){if(this.drop(e.id),e.indices.length===0)return null;let t=new kc(e,e.id);return this.objects.set(e.id,t),this.surfaces.add(t.mesh),this.isWithoutGpu&&this.moves(),this.frames.invalidate(),t}drop(e){let t=this.objects.get(e);t&&(this.selected===t&&(this.selected=null),this.hovered===t&&(this.hovered=null),this.objects.delete(e),t.dispose(),this.frames.invalidate())}clear(){for(let e of[...this.objects.keys()])this.drop(e)}setTouching(e){this.outline.setSelectionColour(e?"#FF5A5F":"#4C9AFF")}setColours(e,t,n,s,r){let o=new De(e);this.three.setClearColor(o,1),Gd.ground.value.set(o.r,o.g,o.b),this.grid.material.color.set(t),this.outline.setHoverColour(n),this.unseen.setColours(s,r),this.frames.invalidate()}resize(e,t,n){this.size.set(Math.max(1,e),Math.max(1,t)),this.three.setPixelRatio(this.pixelRatio),this.three.setSize(this.size.x,this.size.y),this.camera.resize(this.size.x,this.size.y,n)}pick(e,t=()=>!0){this.raycaster.setFromCamera(e,this.camera.three);let n=W0(this.raycaster.ray);if(!n)return null;[this.raycaster.near,this.raycaster.far]=n;let s=[];for(let o of this.objects.values())o.mesh.visible&&t(o.id)&&s.push(o.mesh);let r=this.raycaster.intersectObjects(s,!1)[0];return r?{id:r.object.name,point:r.point,distance_m:r.distance}:null}setClip(e){this.outline.setClip(H0(e)),this.frames.invalidate()}bounds(){let e=new st;for(let t of this.objects.values()){if(!t.mesh.visible)continue;t.mesh.updateMatrixWorld(!0);let n=t.mesh.geometry.boundingSphere.clone().applyMatrix4(t.mesh.matrixWorld),s=new C(1,1,1).multiplyScalar(n.radius/Math.sqrt(3));e.union(new st(n.center.clone().sub(s),n.center.clone().add(s)))}return e}size=new _e(1,1);get pixelRatio(){return Math.min(2,devicePixelRatio)*(this.isMoving?this.pace.detail.pixelShare:1)}cameraMoved(){this.onCameraMoved(),this.moves()}moves(){this.isMoving||(this.isMoving=!0,this.fitPixels()),this.waitForRest()}waitForRest(){clearTimeout(this.restTimer),this.restTimer=window.setTimeout(()=>this.rests(),this.isWithoutGpu?uT:hT)}rests(){if(!this.frames.isIdle)return this.waitForRest();this.isMoving=!1,this.pace.rests(),this.fitPixels(),this.frames.invalidate()}snapshot(){let e=this.isMoving;return this.isMoving=!1,this.fitPixels(),this.draw(0),this.isMoving=e,this.canvas}fitPixels(){this.three.getPixelRatio()!==this.pixelRatio&&this.three.setPixelRatio(this.pixelRatio)}draw(e){this.isMoving&&this.pace.drew(e)&&this.fitPixels();let t=this.isMoving?this.pace.detail.mostTriangles:1/0;F0(this.objects.values(),this.camera.three,this.size.y*this.three.getPixelRatio(),t),this.three.clear(),this.three.render(this.scene,this.camera.three),this.numCalls=this.three.info.render.calls,this.numDrawnTriangles=this.three.info.render.triangles,this.outline.draw(this.three,this.camera.three,this.selected,this.hovered),this.tools.children.length>0&&(this.three.clearDepth(),this.three.render(this.tools,this.camera.three)),B0(this.objects.values()),this.isMoving&&this.waitForRest()}};function ef(i){let e=new DataView(i);if(i.byteLength<20||e.getUint32(0,!0)!==1179937895)throw new Error("the server sent no GLB");let t=e.getUint32(12,!0),n=JSON.parse(new TextDecoder().decode(new Uint8Array(i,20,t))),s=20+t+8,r=[];for(let o of n.scenes[0]?.nodes??[]){let a=n.nodes?.[o];a&&r.push(dT(i,s,n,a))}return r}function dT(i,e,t,n){let s=String(n.extras?.instance_id??""),r=t.nodes?.[n.children?.[0]??-1],o=t.meshes?.[r?.mesh??-1]?.primitives[0],a=t.accessors?.[o?.attributes.POSITION??-1],l=t.accessors?.[o?.indices??-1],c=t.bufferViews?.[a?.bufferView??-1],h=t.bufferViews?.[l?.bufferView??-1];if(!r||!a||!l||!c||!h){let p=new Uint16Array(0);return{id:s,offset_m:[0,0,0],scale_m:1,positions:p,normals:new Int8Array(0),colors:p,indices:p,bytes:0}}let u=e+h.byteOffset,d=l.componentType===5123?new Uint16Array(i.slice(u,u+2*l.count)):new Uint32Array(i.slice(u,u+4*l.count)),f=fT(i,e+c.byteOffset,c.byteStride??20,a.count);return{id:s,offset_m:r.translation??[0,0,0],scale_m:r.scale?.[0]??1,...f,indices:d,bytes:20*a.count+d.byteLength}}function fT(i,e,t,n){let s=new Uint16Array(i,e,t/2*n),r=new Int8Array(i,e,t*n),o=new Uint16Array(4*n),a=new Int8Array(4*n),l=new Uint16Array(4*n);for(let c=0;c<n;++c){let h=c*t/2,u=c*t+8;for(let d=0;d<3;++d)o[4*c+d]=s[h+d]??0,a[4*c+d]=r[u+d]??0,l[4*c+d]=s[h+6+d]??0}return{positions:o,normals:a,colors:l}}var ah=150,pT=2e3,mT=700,lh=class{constructor(e,t,n){this.onSurfaces=e;this.onBytes=t;this.onFailed=n}onSurfaces;onBytes;onFailed;wanted=new Set;running=null;timer=0;last_ms=-1/0;atOnce=ah;fetchedBytes=0;numRequests=0;map={name:"",at:null};fetching=[];start(e){let t=new Set([...this.wanted,...this.running?this.fetching:[]]);return this.stop(),this.atOnce=ah,this.map=e,this.last_ms=-1/0,t}stop(){this.running?.abort(),this.running=null,this.wanted.clear(),clearTimeout(this.timer),this.timer=0}get isIdle(){return this.running===null&&this.wanted.size===0}async takeFirst(e,t){this.fetching=t;let n=this.running=new AbortController;++this.numRequests;try{let s=ef(await e);return n.signal.aborted||this.onSurfaces(s),!0}catch{return n.signal.aborted}finally{this.running===n&&(this.running=null,this.schedule())}}want(e){for(let t of e)this.wanted.add(t);this.schedule()}forget(e){this.wanted.delete(e)}schedule(){if(this.running||this.timer!==0||this.wanted.size===0)return;let e=Math.max(0,this.last_ms+mT-performance.now());this.timer=window.setTimeout(()=>{this.timer=0,this.fetchNext()},e)}tryLater(e,t){let n=t instanceof Xt?t.status:0;if(n===404)return;let s=n===413||n===429;if(n!==0&&!(s&&e.length>1))return this.onFailed(t);s&&(this.atOnce=Math.max(1,Math.floor(e.length/2)));for(let r of e)this.wanted.add(r);this.last_ms=performance.now()+pT}async fetchNext(){let e=[...this.wanted].slice(0,this.atOnce);for(let n of e)this.wanted.delete(n);this.fetching=e;let t=this.running=new AbortController;this.last_ms=performance.now(),++this.numRequests;try{let n=await uc(this.map,e,s=>{this.fetchedBytes+=s,this.onBytes(this.fetchedBytes)},t.signal);if(t.signal.aborted)return;this.atOnce=Math.min(ah,2*this.atOnce),this.onSurfaces(ef(n))}catch(n){if(t.signal.aborted)return;this.tryLater(e,n)}finally{this.running===t&&(this.running=null,this.wanted.size>=ah&&this.last_ms<performance.now()&&(this.last_ms=-1/0),this.schedule())}}};var ch=class{source;constructor(e,t,n,s){this.source=new EventSource(lg(e,t,n)),this.source.addEventListener("open",()=>s.onLink("live")),this.source.addEventListener("change",r=>{let{revision:o,changes:a}=km(JSON.parse(r.data));s.onChanges(o,a)}),this.source.addEventListener("error",()=>{s.onLink("lost"),this.source.readyState===EventSource.CLOSED&&s.onRestart()})}close(){this.source.close()}};var gT=4;async function yT(i){if(!i.object||i.object.box)return i;let e=await No(i.object.name).catch(()=>null);return e&&e.revision>=i.object.revision?{...i,object:e}:i}var xT="Who runs the server makes one by “dhpmap keys create”.",_T={KEY_EXPIRED:"Your key has expired: ask for a new one.",KEY_REVOKED:"Your key was revoked: ask for a new one."},X0=[500,1e3,2e3,4e3],hh=class{constructor(e,t,n,s,r){this.store=e;this.renderer=t;this.surfaces=n;this.ahead=s;this.onTaken=r}store;renderer;surfaces;ahead;onTaken;watch=null;retryTimer=0;numRetries=0;retry=()=>{};generation=0;turn=Promise.resolve();async start(e){let t=this.generation;try{let n=await(this.ahead?.maps??cc());if(t!==this.generation)return;this.store.set("maps",n);let s=md(n,e);if(!s)return this.waitForMaps(e,n.length>0);await this.open(s)}catch(n){this.ahead=null,this.failed(n,()=>this.start(e))}}async open(e){let t=this.close();this.renderer.clear(),this.store.set("at",null),this.store.set("objects",new Map),this.store.set("phase",{is:"loading",bytes:0}),this.store.set("map",e),this.surfaces.start({name:e.name,at:null}),await this.list(e).catch(n=>{t===this.generation&&this.failed(n,()=>this.start(e.id))})}close(){return this.watch?.close(),this.watch=null,clearTimeout(this.retryTimer),++this.generation}async list(e){let t=this.generation,n=this.ahead?.take(e.name)??null;this.ahead=null;let[s,{revision:r,objects:o}]=await(n?.whole??gd(e.name));if(t!==this.generation)return;let a=s.historyId===this.store.get("map")?.historyId;a||oc(this.store),this.store.set("map",s),this.store.set("newest",r);let l=new Map(o.map(c=>[c.id,c]));if(a&&this.store.get("at")!==null)this.store.set("present",l);else{this.store.set("at",null);let c=this.replace(l,r,a),h=u=>n?.surfaces!=null&&u.isPresent&&u.revision<=n.map.revision;n?.surfaces&&this.surfaces.takeFirst(n.surfaces,[...l.keys()]).then(u=>{!u&&t===this.generation&&this.surfaces.want(c.map(({id:d})=>d))}),this.surfaces.want(c.filter(u=>!h(u)).map(({id:u})=>u)),o.every(u=>u.sphere===null)&&this.store.set("phase",{is:"ready"})}this.follow(s,r)}replace(e,t,n){let s=this.store.get("objects");this.store.set("revision",t),this.store.set("objects",e);for(let o of s.keys())e.has(o)||this.renderer.drop(o);let r=o=>n&&s.get(o.id)?.revision===o.revision&&this.renderer.meshOf(o.id)!==null;return[...e.values()].filter(o=>o.sphere!==null&&!r(o))}showAt(e,t){let n=this.store.get("map");if(!n||e===this.store.get("at"))return;this.store.get("at")===null&&this.store.set("present",this.store.get("objects"));let s=e===null?this.store.get("present"):t;this.store.set("at",e);let r=this.surfaces.start({name:n.name,at:e}),o=this.replace(s,e??this.store.get("newest"),!0).map(({id:a})=>a);this.surfaces.want([...o,...[...r].filter(a=>s.has(a))]),e===null&&this.store.set("present",new Map)}follow(e,t){let{generation:n}=this;this.watch=new ch(e.name,t+1,e.historyId,{onLink:s=>{s==="live"&&(this.numRetries=0),this.store.set("link",s)},onRestart:()=>this.listAgain(e),onChanges:(s,r)=>{this.turn=this.turn.then(()=>this.take(n,s,r)).catch(()=>{n===this.generation&&this.listAgain(e)})}})}async take(e,t,n){if(e!==this.generation)return;let s=n.length<=gT?await Promise.all(n.map(yT)):n;if(e===this.generation){if(this.store.set("newest",t),this.store.get("at")!==null)return this.store.set("present",dr(this.store.get("present"),s)),this.onTaken();this.store.set("revision",t),this.store.set("objects",dr(this.store.get("objects"),s));for(let{id:r,kind:o}of s)o==="removed"&&(this.renderer.drop(r),this.surfaces.forget(r));s.some(r=>r.id===this.store.get("selected")&&r.kind==="removed")&&this.store.set("selected",null),this.surfaces.want(s.filter(r=>r.isGeometry).map(r=>r.id)),this.onTaken()}}listAgain(e){let t=this.close();this.later(()=>this.list(e).catch(n=>{t===this.generation&&(n instanceof Xt&&n.status===404?this.start(e.id):n instanceof Xt&&n.status===401?this.failed(n,()=>this.start(e.id)):this.listAgain(e))}))}waitForMaps(e,t){this.ahead=null,this.store.set("phase",t?{is:"no such map",id:e}:{is:"no maps"}),this.store.set("link","live"),this.later(()=>this.start(e))}retryNow(){clearTimeout(this.retryTimer),this.store.set("phase",{is:"connecting"}),this.retry()}failed(e,t){let n=e instanceof Xt&&e.status===401;if(this.store.set("link",n?"off":"lost"),n)return this.retry=t,this.store.set("phase",{is:"locked",why:_T[e.reason]??xT});this.store.set("phase",{is:"failed",why:e instanceof Error?e.message:String(e)}),this.later(t)}later(e){clearTimeout(this.retryTimer),this.retryTimer=window.setTimeout(e,X0[Math.min(this.numRetries++,X0.length-1)])}};var nf=i=>String(Math.round(i*1e3)/1e3);function vT(i){let{x:e,y:t,z:n}=i.position_m;return[e,t,n,i.yaw,i.pitch].map(nf).join(",")}function bT(i){let[e,t,n,s,r,...o]=(i??"").split(",").map(Number),a=[e,t,n,s,r];return o.length>0||!a.every(l=>l!==void 0&&Number.isFinite(l))?null:{position_m:{x:e??0,y:t??0,z:n??0},yaw:s??0,pitch:r??0}}function MT(i){let e=Number(i??"");return i&&Number.isFinite(e)?e:null}function ST(i){let e=Number(i??"");return i&&Number.isSafeInteger(e)&&e>0?e:null}var q0={radius_m:.2,height_m:.6};function Y0(i){try{return jc(i??"")}catch{return[]}}function wT(i){let e=Y0(i);return e.length===2?e:[]}function TT(i){let[e,t]=(i.get("robot")??"").split(",").map(Number),n=(s,[r,o],a)=>s!==void 0&&s>=r&&s<=o?s:a;return{points_m:Y0(i.get("path")),radius_m:n(e,Pr.radius_m,q0.radius_m),height_m:n(t,Pr.height_m,q0.height_m),seenAlone:i.get("seen")==="1"}}var tf=i=>[...i].sort().join(","),$0=i=>new Set(i.split(",").filter(e=>e!==""));function sf(i){let e=new URLSearchParams;return i.mapId&&e.set("map",i.mapId),i.at!==null&&e.set("at",String(i.at)),i.selected!==null&&e.set("object",i.selected),i.query&&e.set("find",i.query),tf(i.hiddenClasses)!=="ceiling"&&e.set("hide",tf(i.hiddenClasses)),i.hiddenObjects.size>0&&e.set("without",tf(i.hiddenObjects)),i.showsGone&&e.set("gone","1"),i.colour!=="sensor"&&e.set("colour",i.colour),i.showsBoxes&&e.set("boxes","1"),i.theme!=="system"&&e.set("theme",i.theme),i.slice_m!==null&&e.set("slice",nf(i.slice_m)),i.measured_m.length===2&&e.set("measure",Jo(i.measured_m,";")),i.clip&&e.set("clip",y0(i.clip)),i.path.points_m.length>0&&(e.set("path",Jo(i.path.points_m,";")),e.set("robot",[i.path.radius_m,i.path.height_m].map(nf).join(",")),i.path.seenAlone&&e.set("seen","1")),i.camera&&e.set("view",vT(i.camera)),e.toString().replaceAll("%2C",",")}function uh(i){let e=new URLSearchParams(i.replace(/^#/,"")),t=e.get("colour"),n=e.get("theme");return{mapId:e.get("map")??"",at:ST(e.get("at")),selected:e.get("object"),query:e.get("find")??"",hiddenClasses:$0(e.get("hide")??"ceiling"),hiddenObjects:$0(e.get("without")??""),showsGone:e.get("gone")==="1",colour:Rr.find(s=>s===t)??"sensor",showsBoxes:e.get("boxes")==="1",theme:n==="dark"||n==="light"?n:"system",slice_m:MT(e.get("slice")),measured_m:wT(e.get("measure")),clip:x0(e.get("clip")),path:TT(e),camera:bT(e.get("view"))}}var j0=["selected","query","hiddenClasses","hiddenObjects","showsGone","colour","showsBoxes","theme","slice_m","measured_m","clip","path"],AT=["map","at",...j0,"camera"],ET=300;function Z0(i){return{mapId:i.get("map")?.id??"",at:i.get("at"),selected:i.get("selected"),query:i.get("query"),hiddenClasses:i.get("hiddenClasses"),hiddenObjects:i.get("hiddenObjects"),showsGone:i.get("showsGone"),colour:i.get("colour"),showsBoxes:i.get("showsBoxes"),theme:i.get("theme"),slice_m:i.get("slice_m"),measured_m:i.get("measured_m"),clip:i.get("clip"),path:i.get("path"),camera:i.get("camera")}}function CT(i,e){for(let t of j0)i.set(t,e[t])}var J0=i=>`${location.origin}${location.pathname}#${sf(Z0(i))}`;function K0(i){let e=uh(location.hash);CT(i,e);let t=0;return i.follow(AT,()=>{t!==0||!i.get("map")||(t=window.setTimeout(()=>{t=0,history.replaceState(null,"",`#${sf(Z0(i))}`)},ET))}),addEventListener("hashchange",()=>location.reload()),e}var RT=500,dh=class{constructor(e,t){this.store=e;this.session=t;e.follow(["map"],()=>e.set("kept",[])),e.follow(["showsTime","newest","map"],()=>this.listSoon())}store;session;wanted=null;isAsking=!1;listTimer=0;isListStale=!1;show(e){this.wanted=e,e===null||e>=this.store.get("newest")?(this.wanted=null,this.session.showAt(null,new Map)):this.isAsking||this.ask(e)}async step(e){this.store.get("kept")[0]?.revision!==this.store.get("newest")&&await this.list();let t=this.store.get("kept"),n=this.wanted??this.store.get("at"),s=n===null?0:t.findIndex(({revision:a})=>a<=n),r=(s<0?t.length:s)-e;this.store.set("showsTime",!0);let o=t[Math.min(t.length-1,r)];o&&this.show(r<=0?null:o.revision)}async ask(e){let t=this.store.get("map");if(t){this.isAsking=!0;try{let{objects:n}=await hc({name:t.name,at:e});this.wanted!==null&&this.store.get("map")?.historyId===t.historyId&&this.session.showAt(e,new Map(n.map(r=>[r.id,r])))}catch(n){this.failed(e,n)}this.isAsking=!1,this.wanted!==null&&this.wanted!==e?this.ask(this.wanted):this.wanted=null}}failed(e,t){this.wanted===e&&(this.wanted=null);let n=t instanceof Xt&&(t.status===410||t.reason==="BAD_REVISION"),s=t instanceof Error?t.message:String(t),r=n?`Revision ${e} is not kept any longer: here is what is`:`The past was not sent: ${s}`;this.store.set("toast",{text:r,tone:"problem"}),n&&this.listSoon()}listSoon(){this.isListStale=this.listTimer!==0,!(!this.store.get("showsTime")||this.isListStale)&&(this.list(),this.listTimer=window.setTimeout(()=>{this.listTimer=0,this.isListStale&&this.listSoon()},RT))}async list(){let e=this.store.get("map");if(!e)return;let t=await rg(e.name).catch(()=>null);t&&this.store.get("map")?.name===e.name&&this.store.set("kept",t)}};function Q0(i,e){let t=matchMedia("(prefers-color-scheme: light)"),n=()=>{let s=i.get("theme");document.documentElement.dataset.theme=s==="system"?t.matches?"light":"dark":s;let r=getComputedStyle(document.documentElement),[o,a,l,c,h]=["--ground","--grid","--text","--unseen","--hatch"].map(u=>r.getPropertyValue(u).trim());e.setColours(o??"",a??"",l??"",c??"",h??"")};t.addEventListener("change",n),i.follow(["theme"],n)}var bs=class{lines;constructor(e,t){this.lines=new Pn(new rt,new xn({color:e,depthTest:!t})),this.lines.frustumCulled=!1}show(e){let t=e.flatMap(({min_m:n,max_m:s})=>{let[r,o]=[[n.x,n.y,n.z],[s.x,s.y,s.z]],a=c=>[0,1,2].map(h=>c&1<<h?o[h]:r[h]);return[0,1,2].flatMap(c=>[0,1,2,3,4,5,6,7].filter(h=>!(h&1<<c)).map(h=>[h,h|1<<c])).flatMap(([c,h])=>[...a(c),...a(h)])});this.lines.geometry.dispose(),this.lines.geometry=new rt,this.lines.geometry.setAttribute("position",new Qe(new Float32Array(t),3)),this.lines.visible=t.length>0}};var PT=.4,IT=1.2,fh=class{constructor(e,t){this.store=e;t.addToScene(this.edges.lines),e.follow(["clip"],()=>{let n=e.get("clip");this.edges.show(n?[n]:[]),t.setClip(n)})}store;edges=new bs("#8B93A3",!1);toggle(){if(this.store.get("clip"))return this.store.set("clip",null);if(this.store.get("selected")!==null)return this.aroundSelection();this.all(IT)}aroundSelection(){let e=this.store.get("objects").get(this.store.get("selected")??""),t=e?jo([e]):null;t&&this.store.set("clip",Zo(t,PT))}all(e){let t=[...this.store.get("objects").values()],n=jo(t);if(!n)return;let{min_m:s,max_m:r}=Zo(n,.1);this.store.set("clip",{min_m:s,max_m:{...r,z:Lr(t)+e}})}};var rf={plain:"#E6E9EF",amber:"#F2B84B"},ey=26,ty=.036,ts=class{group=new rn;clear(){for(let e of[...this.group.children]){e.removeFromParent();let{geometry:t,material:n}=e;e instanceof js||t.dispose(),n.map?.dispose(),n.dispose()}}point(e,t,n){let s=new Ft({color:rf[t],depthTest:!1}),r=new Ke(new us(1,16,12),s);r.position.copy(e),r.scale.setScalar(Math.max(.012,.006*e.distanceTo(n))),this.group.add(r)}line(e,t,n){let s=new rt;s.setAttribute("position",new Qe(new Float32Array([...e.toArray(),...t.toArray()]),3));let r=new Hn(s,new xn({color:rf[n],depthTest:!1}));r.frustumCulled=!1,this.group.add(r)}text(e,t){let n=document.createElement("canvas"),s=n.getContext("2d");if(!s)return;let r=`600 ${ey}px system-ui, sans-serif`;s.font=r,n.width=Math.ceil(s.measureText(t).width)+24,n.height=ey+16,s.fillStyle="#171A21",s.roundRect(0,0,n.width,n.height,8),s.fill(),s.font=r,s.fillStyle=rf.plain,s.textBaseline="middle",s.fillText(t,12,n.height/2+1);let o=new Ys({map:new ao(n),depthTest:!1,sizeAttenuation:!1}),a=new js(o);a.scale.set(ty*n.width/n.height,ty,1),a.center.set(.5,-.2),a.position.copy(e),a.renderOrder=1,this.group.add(a)}};var ph=class{constructor(e,t){this.store=e;this.renderer=t;t.tools.add(this.marks.group),e.follow(["map"],()=>{e.get("measured_m").length===1&&e.set("measured_m",[])}),e.follow(["measured_m","tool"],()=>{this.ahead=null,this.show()})}store;renderer;marks=new ts;ahead=null;click(e){if(!e)return this.store.set("toast",{text:"There is no surface there",tone:"plain"});let{x:t,y:n,z:s}=e.point,r=this.store.get("measured_m");this.store.set("measured_m",[...r.length===1?r:[],{x:t,y:n,z:s}])}hover(e){this.store.get("measured_m").length===1&&(this.ahead=e?.point.clone()??null,this.show())}show(){let e=this.store.get("measured_m").map(({x:s,y:r,z:o})=>new C(s,r,o));e.length===1&&this.ahead&&e.push(this.ahead);let[t,n]=e;this.marks.clear();for(let s of e)this.marks.point(s,"plain",this.renderer.camera.three.position);t&&n&&(this.marks.line(t,n,"plain"),this.marks.text(t.clone().lerp(n,.5),`${t.distanceTo(n).toFixed(2)} m`)),this.renderer.frames.invalidate()}};var of=new C(0,0,1),LT=60,ny=Math.PI/12,mh=class{constructor(e,t,n,s){this.store=e;this.renderer=t;this.edits=n;this.touch=s;e.follow(["selected","objects","pending","tool","draft","at"],()=>this.placeRing())}store;renderer;edits;touch;ring=new Ke(new mo(.94,1,64),new Ft({color:"#4C9AFF",transparent:!0,opacity:.8,side:wt,depthTest:!1}));drag=null;get isBusy(){return this.drag!==null}get object(){let e=this.store.get("objects").get(this.store.get("selected")??""),n=this.store.get("at")===null&&this.store.get("tool")==="select"&&this.store.get("draft")===null;return e?.kind==="thing"&&n?e:null}gripAt(e,t){if(!this.object||this.store.get("pending"))return null;let n=e.intersectPlane(new St(of,-this.ring.position.z),new C),s=n?n.distanceTo(this.ring.position)/this.ring.scale.x:0;return s>.9&&s<1.06?"turn":t?.id===this.object.id?"move":null}begin(e,t){let n=this.gripAt(e,t),s=this.object;if(!n||!s)return;let r=n==="turn"?this.ring.position.z:t?.point.z??0,o=e.intersectPlane(new St(of,-r),new C)??t?.point.clone();o&&(this.drag={object:s,from:s.pose,pivot:$n(s),grip:o,isTurn:n==="turn"})}drags(e,t){if(!this.drag)return;let{object:n,from:s,pivot:r,grip:o,isTurn:a}=this.drag,l=e.intersectPlane(new St(of,-o.z),new C);!l||l.distanceTo(e.origin)>LT||this.store.set("pending",{id:n.id,pose:a?DT(s,r,o,l,t):NT(s,o,l,t)})}async end(){let{drag:e}=this,t=this.store.get("pending");this.drag=null,!(!e||t?.id!==e.object.id)&&await this.send(e.object,t.pose)}cancel(){this.drag&&this.store.set("pending",null),this.drag=null}shift(e){this.object&&!this.store.get("pending")&&this.send(this.object,qo(this.object.pose,e))}turn(e){this.object&&!this.store.get("pending")&&this.send(this.object,Wd(this.object.pose,$n(this.object),e))}send(e,t){return this.edits.move(e,t,this.touch.touchedAt(e,t))}placeRing(){let e=this.object;if(this.ring.removeFromParent(),e?.box){let t=this.store.get("pending"),n=$n(e),{x:s,y:r,z:o}=e.box.size_m;this.ring.position.set(n.x,n.y,n.z-o/2),t?.id===e.id&&this.drag&&!this.drag.isTurn&&(this.ring.position.x+=t.pose.translation_m.x-e.pose.translation_m.x,this.ring.position.y+=t.pose.translation_m.y-e.pose.translation_m.y),this.ring.scale.setScalar(Math.max(.3,.55*Math.hypot(s,r)+.12)),this.renderer.tools.add(this.ring)}this.renderer.frames.invalidate()}};function NT(i,e,t,n){let s=t.clone().sub(e).setZ(0);return n&&s.set(Math.round(s.x*10)/10,Math.round(s.y*10)/10,0),qo(i,s)}function DT(i,e,t,n,s){let r=a=>Math.atan2(a.y-e.y,a.x-e.x),o=r(n)-r(t);return Wd(i,e,s?Math.round(o/ny)*ny:o)}var Dr=i=>({read_revision:i.at??0});async function iy(i,e,t){let n={points_m:[e],...Dr(i)},[s,r]=await Promise.all([ln(`${i.name}:queryDistances`,{...n,options:{excluded_submaps:[`${i.name}/submaps/${t}`]}}),ln(`${i.name}:queryPoints`,n)]),o=qe(ot(s.results)[0]),a=qe(ot(r.results)[0]);return{distance_m:ze(o.distance_m),nearest:o.nearest_point_m===void 0||o.nearest_point_m===null?null:wn(o.nearest_point_m),neighbour:o.submap?`${Xe(o.class_name)||"unknown"} #${Tn(Xe(o.submap))}`:null,ownerId:a.submap?Tn(Xe(a.submap)):null,classConfidence:ze(a.class_confidence)}}async function sy(i,e,t){let n=await ln(`${i.name}:queryOccupancySlice`,{min_z_m:e,max_z_m:t,...Dr(i)});return{width:ze(n.width),height:ze(n.height),resolution_m:ze(n.resolution_m),origin_m:wn(n.origin_m),cells:Uint8Array.from(atob(Xe(n.cells)),s=>s.charCodeAt(0))}}var OT=50;async function ry(i,e,t){let n=await ln(`${i.name}:castRays`,{rays:[{origin_m:e,direction:t}],options:{max_distance_m:OT},...Dr(i)}),s=qe(ot(n.results)[0]);return{point_m:s.point_m!==void 0&&s.point_m!==null?wn(s.point_m):null,distance_m:ze(s.distance_m),free_m:ze(s.free_distance_m),isSeen:s.status!=="UNKNOWN",id:s.submap?Tn(Xe(s.submap)):null}}async function oy(i,e,t,n,s){let r=await ln(`${i.name}/submaps:search`,{near_point_m:e,page_size:s,options:{excluded_submaps:[`${i.name}/submaps/${n}`],...t===""?{}:{class_names:[t]}},...Dr(i)});return ot(r.matches).map(o=>{let a=qe(o),{id:l,label:c,kind:h}=hr(a.submap);return{id:l,label:c,kind:h,distance_m:ze(a.distance_m)}})}async function gh(i,e,t){let n=await ln(`${i}:checkCollisions`,{bodies:[{box:e}],all_contacts:!0,options:{unknown_policy:"FREE",excluded_submaps:t.map(s=>`${i}/submaps/${s}`)}});return ot(qe(ot(n.results)[0]).contacts).map(s=>{let r=qe(s);return{id:Tn(Xe(r.submap)),isUnder:wn(r.normal).z>.7}})}var UT=30,FT=6,BT=500,yh=class{constructor(e){this.store=e;e.follow(["selected","clicked","asksNear","nearClass","revision"],()=>this.update())}store;isAsking=!1;isStale=!1;update(){!this.store.get("asksNear")||this.store.get("selected")===null||(this.isAsking?this.isStale=!0:this.ask())}async ask(){let e=gi(this.store),t=this.store.get("nearClass"),n=this.store.get("objects").get(this.store.get("selected")??"");if(!e||!n)return;this.isAsking=!0,this.isStale=!1;let s=this.store.get("clicked"),{x:r,y:o,z:a}=s?.id===n.id?s.point_m:$n(n),c=(await oy(e,{x:r,y:o,z:a},t,n.id,UT).catch(()=>null))?.filter(({kind:h})=>t!==""||h==="thing").slice(0,FT);c&&this.store.set("near",{id:n.id,className:t,objects:c}),window.setTimeout(()=>{this.isAsking=!1,this.isStale&&this.update()},BT)}};async function ay(i,e,t,n){let s=await ln(`${i.name}:checkTrajectory`,{robot:e,trajectories:[{waypoints:t.map(c=>({translation_m:c}))}],options:{unknown_policy:n?"OCCUPIED":"FREE"},include_clearance:!0,...Dr(i)}),r=qe(ot(s.results)[0]),o=qe(ot(r.contacts)[0]),a=qe(o.contact),l=r.clearance?qe(r.clearance):null;return{revision:ze(s.revision),isFree:r.valid===!0,contact:r.valid===!0?null:{waypoint:ze(o.waypoint),fraction:ze(o.fraction),id:a.submap?Tn(Xe(a.submap)):null,point_m:wn(a.point_m)},clearance:l&&{distance_m:ze(l.distance_m),id:l.submap?Tn(Xe(l.submap)):null}}}var ly=.03,af="#E6E9EF",cy="#FF5A5F",Qo=(i,e)=>new Ft({color:i,opacity:e,transparent:!0,side:wt,depthTest:!1,depthWrite:!1}),xh=class{group=new rn;free=Qo(af,.45);beyond=Qo(cy,.45);line=Qo(af,.95);robot=Qo(af,.22);touching=Qo(cy,.4);show(e,t,n){this.clear();let s=2*(t[0]?.radius_m??0),r=n?.contact??null,o=r?r.waypoint+r.fraction:1/0;e.forEach((u,d)=>{this.disc(u,s/2,d<=o?this.free:this.beyond),this.disc(u,Math.min(.05,s/4),this.line);let f=e[d+1];if(!f)return;let p=u.clone().lerp(f,Math.min(1,Math.max(0,o-d)));this.strip(u,p,s,this.free),this.strip(p,f,s,this.beyond),this.strip(u,f,.02,this.line)});let a=e.at(-1);if(!a)return;let l=e[Math.min(e.length-1,Math.floor(o))]??a,c=e[Math.min(e.length-1,Math.floor(o)+1)]??a,h=r?l.clone().lerp(c,r.fraction):a;for(let u of t)this.ball(h,u,r?this.touching:this.robot)}clear(){for(let e of[...this.group.children])e.removeFromParent(),e.geometry.dispose()}add(e,t){let n=new Ke(e,t);return this.group.add(n),n}disc(e,t,n){this.add(new ho(t,32),n).position.copy(e).setZ(e.z+ly)}strip(e,t,n,s){let r=t.clone().sub(e),o=Math.hypot(r.x,r.y);if(o<1e-4)return;let a=this.add(new In(o,n),s);a.position.copy(e).addScaledVector(r,.5).setZ((e.z+t.z)/2+ly),a.rotation.z=Math.atan2(r.y,r.x)}ball(e,{center_m:t,radius_m:n},s){this.add(new us(n,20,14),s).position.set(e.x+t.x,e.y+t.y,e.z+t.z)}};var zT=300,VT=.3,_h=class{constructor(e,t){this.store=e;this.renderer=t;e.follow(["path","pathAnswer"],()=>this.show()),e.follow(["path","revision","map"],()=>this.update())}store;renderer;shape=new xh;isAsking=!1;isStale=!1;click(e,t){let n=e?.point??t,s=this.store.get("path");if(!n||s.points_m.length>=1e3)return;let r=n.z<=VT?n.z:s.points_m.at(-1)?.z??0;this.store.set("path",{...s,points_m:[...s.points_m,{x:n.x,y:n.y,z:r}]})}update(){this.store.get("path").points_m.length===0?this.store.set("pathAnswer",null):this.isAsking?this.isStale=!0:this.ask()}async ask(){let e=gi(this.store),t=this.store.get("path");if(e){this.isAsking=!0,this.isStale=!1;try{let n=jd(t.radius_m,t.height_m),s=t.points_m.length===1?[...t.points_m,...t.points_m]:t.points_m,r=await ay(e,n,s,t.seenAlone);this.store.get("path")===t&&this.store.get("map")?.name===e.name&&this.store.set("pathAnswer",r)}catch(n){let s=n instanceof Error?n.message:String(n);this.store.set("pathAnswer",null),this.store.set("toast",{text:`The path was not checked: ${s}`,tone:"problem"})}window.setTimeout(()=>{this.isAsking=!1,this.isStale&&this.update()},zT)}}show(){let{points_m:e,radius_m:t,height_m:n}=this.store.get("path");if(this.shape.group.removeFromParent(),e.length>0){let s=e.map(({x:r,y:o,z:a})=>new C(r,o,a));this.shape.show(s,jd(t,n),this.store.get("pathAnswer")),this.renderer.tools.add(this.shape.group)}else this.shape.clear();this.renderer.frames.invalidate()}};var GT=4,HT=250,WT=8,vh=class{constructor(e,t,n,s,r,o,a){this.store=e;this.renderer=t;this.moveTool=n;this.placeTools=s;this.draftTool=r;this.label=o;this.focusOn=a;let{canvas:l}=t;l.addEventListener("pointerdown",c=>this.down(c)),l.addEventListener("pointermove",c=>this.moved(c)),l.addEventListener("pointerup",c=>this.up(c)),l.addEventListener("pointercancel",c=>this.cancelled(c)),l.addEventListener("pointerleave",()=>this.unhover()),l.addEventListener("wheel",c=>this.wheel(c),{passive:!1}),l.addEventListener("contextmenu",c=>c.preventDefault()),l.addEventListener("dblclick",()=>{this.hit&&this.focusOn(this.hit.id)})}store;renderer;moveTool;placeTools;draftTool;label;focusOn;pointers=new Map;gesture="none";start=new _e;anchor=new C;hit=null;hasMoved=!1;wheelAnchor=null;hoverAsked=!1;hoverAt=new _e;anchorAt(e,t){return t?t.point.clone():this.floorAt(e)??this.renderer.camera.rayAt(e).at(WT,new C)}floorAt(e){let t=this.renderer.camera.rayAt(e),n=t.intersectPlane(new St(new C(0,0,1),0),new C);return n&&n.distanceTo(t.origin)<40?n:null}placeOf(e){let t=this.renderer.canvas.getBoundingClientRect();return new _e((e.clientX-t.left)/t.width*2-1,1-(e.clientY-t.top)/t.height*2)}down(e){this.renderer.canvas.setPointerCapture(e.pointerId),this.renderer.canvas.focus({preventScroll:!0}),this.pointers.set(e.pointerId,new _e(e.clientX,e.clientY));let t=this.placeOf(e);if(this.pointers.size>1){this.moveTool.cancel(),this.gesture="pan",this.hasMoved=!0;return}this.hit=this.renderer.pick(t),this.anchor=this.anchorAt(t,this.hit),this.start.set(e.clientX,e.clientY),this.hasMoved=!1;let n=e.button!==0||e.shiftKey||e.ctrlKey||e.metaKey,s=n?null:this.moveTool.gripAt(this.renderer.camera.rayAt(t),this.hit);this.gesture=n?"pan":s?"move":"orbit"}moved(e){let t=this.pointers.get(e.pointerId);if(!t)return this.hover(e);let n=new _e(e.clientX,e.clientY);if(!this.hasMoved&&n.distanceTo(this.start)<GT)return;if(this.hasMoved||this.begin(),this.pointers.set(e.pointerId,n),this.pointers.size>1)return this.pinch(e.pointerId,t,n);let{camera:s}=this.renderer;this.gesture==="orbit"&&this.store.get("walks")?s.look(n.x-t.x,n.y-t.y):this.gesture==="orbit"&&s.orbit(this.anchor,n.x-t.x,n.y-t.y),this.gesture==="pan"&&s.pan(this.anchor,this.placeAt(t),this.placeAt(n)),this.gesture==="move"&&this.moveTool.drags(s.rayAt(this.placeAt(n)),e.shiftKey)}begin(){this.hasMoved=!0,this.unhover(),this.gesture==="move"&&this.moveTool.begin(this.renderer.camera.rayAt(this.placeAt(this.start)),this.hit),this.renderer.canvas.dataset.grab=this.gesture}placeAt(e){return this.placeOf({clientX:e.x,clientY:e.y})}pinch(e,t,n){let s=[...this.pointers.entries()].find(([a])=>a!==e)?.[1];if(!s)return;let r=a=>this.placeAt(a.clone().add(s).multiplyScalar(.5));this.renderer.camera.pan(this.anchor,r(t),r(n));let o=t.distanceTo(s)/Math.max(1,n.distanceTo(s));this.renderer.camera.zoom(this.anchor,Math.log(o)/Math.log(1.0015))}up(e){this.pointers.delete(e.pointerId)&&(delete this.renderer.canvas.dataset.grab,!(this.pointers.size>0)&&(this.gesture==="move"&&this.hasMoved&&this.moveTool.end(),!this.hasMoved&&e.button===0&&this.click(),this.gesture="none"))}cancelled(e){this.pointers.delete(e.pointerId),this.moveTool.cancel(),this.gesture="none"}click(){let e=this.store.get("tool");if(e!=="select")return this.placeTools[e].click(this.hit,this.floorAt(this.placeAt(this.start)));if(this.store.get("draft")?.is==="merge"&&this.hit)return this.draftTool.choose(this.hit.id);let t=this.hit?.point;this.store.set("clicked",t&&this.hit?{id:this.hit.id,point_m:{x:t.x,y:t.y,z:t.z}}:null),this.store.set("selected",this.hit?.id??null)}wheel(e){e.preventDefault();let t=performance.now();if(!this.wheelAnchor||t-this.wheelAnchor.at_ms>HT){let r=this.placeOf(e);this.wheelAnchor={point:this.anchorAt(r,this.renderer.pick(r)),at_ms:t}}this.wheelAnchor.at_ms=t;let n=e.deltaMode===WheelEvent.DOM_DELTA_LINE?30:1,s=e.ctrlKey?4:1;this.renderer.camera.zoom(this.wheelAnchor.point,Math.max(-400,Math.min(400,e.deltaY*n*s))),this.unhover()}hover(e){e.pointerType!=="touch"&&(this.hoverAt.set(e.clientX,e.clientY),!this.hoverAsked&&(this.hoverAsked=!0,requestAnimationFrame(()=>{if(this.hoverAsked=!1,this.pointers.size>0)return;let t=this.placeAt(this.hoverAt),n=this.renderer.pick(t);this.store.set("hovered",n?.id??null);let s=this.store.get("tool");s!=="select"&&this.placeTools[s].hover?.(n,this.floorAt(t));let r=this.moveTool.gripAt(this.renderer.camera.rayAt(t),n);this.renderer.canvas.dataset.over=s!=="select"?"probe":r??(n?"object":""),this.label.style.transform=`translate(${this.hoverAt.x+14}px, ${this.hoverAt.y+16}px)`})))}unhover(){this.store.set("hovered",null)}};var bh=class{constructor(e,t){this.store=e;this.renderer=t;t.tools.add(this.marks.group),e.follow(["probe"],()=>this.show())}store;renderer;marks=new ts;click(e){e&&this.ask(e.point,e.id)}async ask(e,t){let n=gi(this.store);if(!n)return;let s={x:e.x,y:e.y,z:e.z};this.store.set("probe",{point_m:s,id:t,answer:null});try{let r=await iy(n,s,t);this.store.get("probe")?.point_m===s&&this.store.set("probe",{point_m:s,id:t,answer:r})}catch(r){this.store.set("toast",{text:`Not answered: ${r instanceof Error?r.message:String(r)}`,tone:"problem"})}}show(){let e=this.store.get("probe");if(this.marks.clear(),e){let t=this.renderer.camera.three.position,n=new C(e.point_m.x,e.point_m.y,e.point_m.z);this.marks.point(n,"plain",t);let s=e.answer?.nearest;if(s){let r=new C(s.x,s.y,s.z);this.marks.point(r,"amber",t),this.marks.line(n,r,"amber")}}this.renderer.frames.invalidate()}};var XT=.1,qT=50,$T=300,Mh=class{constructor(e,t){this.store=e;this.renderer=t;t.tools.add(this.marks.group),e.follow(["tool"],()=>this.begin=null),e.follow(["ray","tool"],()=>this.show()),e.follow(["revision","map"],()=>this.update())}store;renderer;marks=new ts;begin=null;isAsking=!1;isStale=!1;click(e){if(!e)return this.store.set("toast",{text:"There is no surface there",tone:"plain"});if(!this.begin){let s=this.renderer.camera.three.position.clone().sub(e.point).normalize();return this.begin=e.point.clone().addScaledVector(s,XT),this.store.set("ray",null),this.show()}let t=e.point.clone().sub(this.begin),n=this.begin;this.begin=null,this.cast(n,t)}alongTheView(){let{three:e}=this.renderer.camera;this.cast(e.position.clone(),e.getWorldDirection(new C))}cast(e,t){let{x:n,y:s,z:r}=t.normalize(),o={x:e.x,y:e.y,z:e.z};this.store.set("ray",{origin_m:o,direction:{x:n,y:s,z:r},answer:null}),this.update()}update(){this.store.get("ray")&&(this.isAsking?this.isStale=!0:this.ask())}async ask(){let[e,t]=[gi(this.store),this.store.get("ray")];if(!(!e||!t)){this.isAsking=!0,this.isStale=!1;try{let n=await ry(e,t.origin_m,t.direction);this.store.get("ray")?.origin_m===t.origin_m&&this.store.set("ray",{...t,answer:n})}catch(n){let s=n instanceof Error?n.message:String(n);this.store.set("toast",{text:`Not answered: ${s}`,tone:"problem"})}window.setTimeout(()=>{this.isAsking=!1,this.isStale&&this.update()},$T)}}show(){let e=this.renderer.camera.three.position,t=this.store.get("ray");if(this.marks.clear(),this.begin&&this.marks.point(this.begin,"plain",e),t){let n=new C(t.origin_m.x,t.origin_m.y,t.origin_m.z),s=c=>n.clone().add(new C(t.direction.x,t.direction.y,t.direction.z).multiplyScalar(c)),{distance_m:r,free_m:o,point_m:a}=t.answer??{distance_m:0,free_m:0,point_m:null},l=a?r:Math.min(qT,r);this.marks.point(n,"plain",e),this.marks.line(n,s(Math.min(o,l)),"plain"),o<l&&this.marks.line(s(o),s(l),"amber"),a&&this.marks.point(s(r),"amber",e),a&&this.marks.text(s(r),`${r.toFixed(2)} m`)}this.renderer.frames.invalidate()}};var YT=2,jT=.15,Sh=class{constructor(e,t){this.store=e;this.renderer=t;e.follow(["tool"],()=>{this.corner=null,e.get("tool")!=="region"&&e.set("regionDraft",null)}),e.follow(["tool","revision","map","history"],()=>{this.refresh()}),e.follow(["tool","regions","regionDraft"],()=>this.show())}store;renderer;drawn=new bs("#E6E9EF",!0);there=new bs("#F2B84B",!0);corner=null;asked=0;click(e,t){let n=e?.point??t;n&&(this.spread(n),this.corner=this.corner?null:n.clone())}hover(e,t){let n=e?.point??t;n&&this.corner&&this.spread(n)}around(){let e=this.store.get("objects").get(this.store.get("selected")??""),t=e?jo([e]):null;if(this.corner=null,t)return this.propose(Zo(t,jT));let n=this.renderer.bounds().getCenter(this.renderer.camera.three.position.clone());this.propose(this.boxOver({x:n.x-.5,y:n.y-.5},{x:n.x+.5,y:n.y+.5}))}spread(e){this.propose(this.boxOver(this.corner??e,e))}boxOver(e,t){let n=Lr(this.store.get("objects").values());return Yo({x:e.x,y:e.y,z:n},{x:t.x,y:t.y,z:n+YT})}propose(e){let t=this.store.get("regionDraft");this.store.set("regionDraft",{name:t?.name??this.freeName(),box:e,clears:t?.clears??!0})}freeName(){let e=new Set(this.store.get("regions").map(({name:t})=>t));for(let t=1;;++t)if(!e.has(`region-${t}`))return`region-${t}`}async refresh(){let e=this.store.get("map");if(!e||this.store.get("tool")!=="region")return;let t=++this.asked,n=await Zm(e.name).catch(()=>null);n&&t===this.asked&&this.store.set("regions",n)}show(){let e=this.store.get("tool")==="region",t=this.store.get("regionDraft");this.drawn.show(e&&t?[t.box]:[]),this.there.show(e?this.store.get("regions").map(({box:n})=>n):[]),this.renderer.tools.add(this.drawn.lines,this.there.lines),this.renderer.frames.invalidate()}};var ZT=Uint32Array.from({length:256},(i,e)=>{let t=e;for(let n=0;n<8;++n)t=t&1?3988292384^t>>>1:t>>>1;return t});function JT(i){let e=4294967295;for(let t of i)e=ZT[(e^t)&255]^e>>>8;return(e^4294967295)>>>0}function hy(i,e,t){let n=new TextEncoder().encode(`tEXt${e}\0${t}`),s=new Uint8Array(i.length+8+n.length),r=new DataView(s.buffer);return s.set(i.subarray(0,33)),r.setUint32(33,n.length-4),s.set(n,37),r.setUint32(37+n.length,JT(n)),s.set(i.subarray(33),41+n.length),s}var lf=28,cf=10,hf=i=>getComputedStyle(document.documentElement).getPropertyValue(i).trim();async function uy(i,e,t){let n=i.get("map");if(!n)return;let s=`${n.displayName}, revision ${i.get("revision")}`,r=KT(e.snapshot(),s,t),o=await new Promise(h=>r.toBlob(h,"image/png"));if(!o)return i.set("toast",{text:"The browser makes no picture of it",tone:"problem"});let a=hy(new Uint8Array(await o.arrayBuffer()),"Source",encodeURI(decodeURI(t))),l=URL.createObjectURL(new Blob([a],{type:"image/png"})),c=document.createElement("a");c.href=l,c.download=`${n.id}-r${i.get("revision")}.png`,c.click(),window.setTimeout(()=>URL.revokeObjectURL(l),6e4),i.set("toast",{text:`${c.download} is saved, with the link of this view in it`,tone:"plain"})}function KT(i,e,t){let n=Math.max(1,devicePixelRatio),s=document.createElement("canvas");s.width=i.width,s.height=i.height+lf*n;let r=s.getContext("2d");if(!r)return i;r.drawImage(i,0,0),r.fillStyle=hf("--panel"),r.fillRect(0,i.height,s.width,lf*n),r.scale(n,n),r.font="600 12px system-ui, sans-serif",r.textBaseline="middle",r.fillStyle=hf("--text");let o=i.height/n+lf/2;r.fillText(e,cf,o);let a=2*cf+r.measureText(e).width;return r.font="11px ui-monospace, monospace",r.fillStyle=hf("--muted"),r.fillText(QT(r,t,s.width/n-a-cf),a,o),s}function QT(i,e,t){if(i.measureText(e).width<=t)return e;let n=i.measureText("m").width;return`${e.slice(0,Math.max(0,Math.floor(t/n)-1))}…`}var eA=100;function tA(i){let e=qe(i);if(e.map_from_sensor===void 0||e.map_from_sensor===null)return null;let t=ot(e.packed_path_m).map(ze),n=[];for(let s=0;s+2<t.length;s+=3)n.push({x:t[s]??0,y:t[s+1]??0,z:t[s+2]??0});return{name:Xe(e.session)||"a robot",isFeeding:e.feeding===!0,pose:sc(e.map_from_sensor),path_m:n}}async function dy(i){let e=await Xn(`${i}/sessions?page_size=${eA}`);return ot(e.sessions).map(tA).filter(t=>t!==null)}var[wh,Th,Ah]=[.32,.2,.15],uf=[[-Th,-Ah,wh],[Th,-Ah,wh],[Th,Ah,wh],[-Th,Ah,wh]],Eh=class{group=new rn;path=new xn({color:"#E6E9EF",transparent:!0,opacity:.7});frame=new xn({color:"#E6E9EF"});away=new xn({color:"#8B93A3"});face=new Ft({color:"#E6E9EF",transparent:!0,opacity:.18,side:wt,depthWrite:!1});show(e){for(let t of[...this.group.children])t.removeFromParent(),t.geometry.dispose();for(let{pose:t,path_m:n,isFeeding:s}of e){let r=new Hn(df(n.flatMap(({x:f,y:p,z:v})=>[f,p,v])),this.path);r.frustumCulled=!1;let o=uf.flatMap((f,p)=>[0,0,0,...f,...f,...uf[(p+1)%4]]),a=new Pn(df(o),s?this.frame:this.away),[l,c,h,u]=uf,d=new Ke(df([...l,...c,...h,...l,...h,...u]),this.face);for(let f of[a,d])f.matrixAutoUpdate=!1,f.matrix.copy(Un(t));this.group.add(r,a,d)}}};function df(i){let e=new rt;return e.setAttribute("position",new Qe(new Float32Array(i),3)),e}var nA=500,Ch=class{constructor(e,t){this.store=e;t.addToScene(this.marks.group),e.follow(["map"],()=>e.set("robots",[])),e.follow(["map","revision"],()=>this.update()),e.follow(["robots","at"],()=>{this.marks.show(e.get("at")===null?e.get("robots"):[]),t.frames.invalidate()})}store;marks=new Eh;isAsking=!1;isStale=!1;update(){this.isAsking?this.isStale=!0:this.ask()}async ask(){let e=this.store.get("map");if(!e)return;this.isAsking=!0,this.isStale=!1;let t=await dy(e.name).catch(()=>null);t&&this.store.get("map")?.name===e.name&&!(t.length===0&&this.isEmpty)&&this.store.set("robots",t),window.setTimeout(()=>{this.isAsking=!1,this.isStale&&this.update()},nA)}get isEmpty(){return this.store.get("robots").length===0}};var ff={free:0,occupied:100,unknown:255};var iA=[240,243,248,235],sA=[96,170,150,110],rA=[242,184,75,60],Rh=class{mesh=new Ke(new In(1,1),new Ft({transparent:!0,side:wt,depthWrite:!1,toneMapped:!1}));show(e,t){let{width:n,height:s,resolution_m:r,origin_m:o}=e,a=new Uint8Array(4*n*s);e.cells.forEach((c,h)=>a.set(c===ff.occupied?iA:c===ff.free?sA:rA,4*h));let l=new wi(a,n,s);l.colorSpace=dn,l.magFilter=Dt,l.needsUpdate=!0,this.mesh.material.map?.dispose(),this.mesh.material.map=l,this.mesh.material.needsUpdate=!0,this.mesh.scale.set(n*r,s*r,1),this.mesh.position.set(o.x+this.mesh.scale.x/2,o.y+this.mesh.scale.y/2,t)}};var fy=.1,oA=300,Ph=class{constructor(e,t){this.store=e;this.renderer=t;e.follow(["slice_m","revision","map"],()=>this.update())}store;renderer;plane=new Rh;isAsking=!1;isStale=!1;update(){this.store.get("slice_m")===null?(this.plane.mesh.removeFromParent(),this.renderer.frames.invalidate()):this.isAsking?this.isStale=!0:this.ask()}async ask(){let e=gi(this.store),t=this.store.get("slice_m");if(!(!e||t===null)){this.isAsking=!0,this.isStale=!1;try{let n=await sy(e,t-fy/2,t+fy/2);this.store.get("slice_m")!==null&&n.width>0&&(this.plane.show(n,t),this.renderer.addToScene(this.plane.mesh))}catch(n){let s=n instanceof Error?n.message:String(n);this.store.set("toast",{text:`No slice: ${s}`,tone:"problem"})}window.setTimeout(()=>{this.isAsking=!1,this.isStale&&this.update()},oA)}}};var aA=1.6,lA=1.5,cA=2.5,hA=.2,uA=-.12,pf={ArrowUp:[1,0],ArrowDown:[-1,0],ArrowLeft:[0,-1],ArrowRight:[0,1]},Ih=class{constructor(e,t){this.store=e;this.renderer=t;e.follow(["walks"],()=>e.get("walks")?this.begin():this.end()),e.follow(["map"],()=>e.set("walks",!1)),addEventListener("keyup",n=>this.held.delete(n.key)),addEventListener("blur",()=>this.held.clear())}store;renderer;held=new Set;before=null;last_ms=0;isFast=!1;press(e){return!this.store.get("walks")||!(e.key in pf)||e.altKey?!1:(this.isFast=e.shiftKey,this.held.has(e.key)||(this.held.size===0&&(this.last_ms=performance.now(),this.renderer.frames.animate(t=>this.step(t))),this.held.add(e.key)),!0)}step(e){let t=Math.min(hA,Math.max(0,(e-this.last_ms)/1e3));this.last_ms=e;let[n,s]=[0,0];for(let o of this.held)n+=pf[o]?.[0]??0,s+=pf[o]?.[1]??0;let r=lA*(this.isFast?cA:1)*t;return(n!==0||s!==0)&&this.renderer.camera.walk(n*r,s*r),this.held.size>0&&this.store.get("walks")}begin(){let{camera:e}=this.renderer;this.before=e.view;let n=this.renderer.pick(new _e(0,0))?.point??this.renderer.bounds().getCenter(new C),s=Lr(this.store.get("objects").values())+aA;e.flyTo({position_m:{x:n.x,y:n.y,z:s},yaw:e.yaw,pitch:uA},!1)}end(){this.held.clear(),this.before&&this.store.get("map")&&this.renderer.camera.flyTo(this.before,!1),this.before=null}};var dA=.08,fA=.04,Lh=class{constructor(e){this.store=e;e.follow(["pending"],()=>{if(e.get("pending"))return this.isAsking?void(this.isStale=!0):void this.ask();this.own=null,e.set("touched",[])})}store;isAsking=!1;isStale=!1;own=null;async ask(){let e=this.store.get("map"),t=this.store.get("pending"),n=this.store.get("objects").get(t?.id??"");if(!(!e||!t||!n?.box)){this.isAsking=!0,this.isStale=!1;try{this.own?.id!==n.id&&(this.own={id:n.id,excluded:await this.excludedBy(e.name,n)});let s=await gh(e.name,mf(n,t.pose),this.own.excluded);this.store.get("pending")?.id===n.id&&this.store.set("touched",[...new Set(s.map(({id:r})=>r))])}catch{this.store.set("touched",[])}this.isAsking=!1,this.isStale&&this.store.get("pending")&&this.ask()}}async touchedAt(e,t){let n=this.store.get("map");if(!n||!e.box)return[];try{let s=await gh(n.name,mf(e,t),await this.excludedBy(n.name,e));return[...new Set(s.map(({id:r})=>r))]}catch{return[]}}async excludedBy(e,t){let n=await gh(e,mf(t,t.pose),[t.id]),s=r=>this.store.get("objects").get(r)?.kind==="thing";return[t.id,...n.filter(({id:r,isUnder:o})=>o||s(r)).map(({id:r})=>r)]}};function mf(i,e){let t=i.box??{pose:e,size_m:{x:0,y:0,z:0}},n=l=>Math.max(fA,l-2*dA),s=Zd(i.pose,e).multiply(Un(t.pose)),{x:r,y:o,z:a}=t.size_m;return{pose:zc(s),size_m:{x:n(r),y:n(o),z:n(a)}}}var py=900,pA=300,mA={yaw:Math.PI/2,pitch:-Math.PI/2},gA={yaw:Math.PI/2+.34,pitch:-.95};function yA(i,e){let t;try{t=new oh(()=>i.set("camera",t?.camera.view??null))}catch{i.set("phase",{is:"no webgl"}),document.body.append(U("main",{class:"scene"},Xd(i)));return}let n=new Qc(i,t),s=new lc(i),r=new dc(i,s),o=new mh(i,t,r,new Lh(i)),a={probe:new bh(i,t),path:new _h(i,t),ray:new Mh(i,t),measure:new ph(i,t),region:new Sh(i,t)},l=new fh(i,t),c=new Vc(i,t,r);new Ch(i,t),new yh(i);let h=new Ph(i,t),u=new lh(O=>{for(let I of O)i.get("objects").has(I.id)&&t.put(I);n.refresh(),i.get("phase").is==="loading"&&(i.set("phase",{is:"ready"}),i.get("camera")||p(!0)),S.count()},O=>{i.get("phase").is==="loading"&&i.set("phase",{is:"loading",bytes:O})},O=>i.set("toast",{text:`Surfaces were not sent: ${O instanceof Error?O.message:String(O)}`,tone:"problem"})),d=()=>innerWidth>py,f=()=>{t.camera.covered_px=d()&&!y.element.hidden?y.element.offsetWidth:0},p=(O=!1,I=gA)=>{let k=t.bounds();if(k.isEmpty())return;let H=k.getSize(new C);f(),t.camera.frame(k.getCenter(new C),.36*Math.hypot(H.x,H.y,.5*H.z),I,O)},v=O=>{let I=i.get("objects").get(O);f(),I&&t.camera.frame($n(I),1.6*Math.min(4,I.sphere?.radius_m??1),null,!1)},m=()=>{let O=d()&&!document.body.classList.contains("no-list");t.resize(R.clientWidth,R.clientHeight,O?M.element.offsetWidth:0)},g=()=>{document.body.classList.toggle("no-list"),m()},x=new hh(i,t,u,e,()=>{s.refresh()}),b=new dh(i,x),_=O=>b.show(O),M=new $c(i,v),A={openMap:O=>{i.set("selected",null),i.set("hiddenObjects",new Set),i.set("camera",null),oc(i),x.open(O).then(()=>s.refresh())},frameAll:()=>{i.set("walks",!1),p()},lookDown:()=>{i.set("walks",!1),p(!1,mA)},toggleList:g,showRevision:_,stepTime:O=>b.step(O),toggleClip:()=>l.toggle(),saveScreenshot:()=>{uy(i,t,J0(i))},focusSearch:()=>{document.body.classList.contains("no-list")&&g(),M.search.focus()},focusSelection:()=>{i.get("selected")!==null&&v(i.get("selected")??"")}},y=new Gc(i,r,o,v,[R0(i,()=>b.show(null)),N0(i),_0(i,l),S0(i),I0(i,a.ray),P0(i),L0(i,r,a.region)]),S=new Jc(i,t,r),N=M0(i),E=Xd(i,A.openMap,()=>x.retryNow()),R=U("main",{class:"scene",aria:{label:"Map"}},t.canvas,E);t.canvas.tabIndex=0,t.canvas.setAttribute("aria-label","The map in 3D. Keys: question mark."),document.body.append(new Kc(i,r,A).element,M.element,R,y.element,O0(i,{show:_,step:A.stepTime}),S.element,N,E0(i)),innerWidth<=py&&g(),new vh(i,t,o,a,c,N,v),b0(i,r,o,new Ih(i,t),A),Q0(i,t),new ResizeObserver(m).observe(R);let L=K0(i);L.camera?t.camera.setView(L.camera):i.set("camera",null),x.start(L.mapId).then(()=>{s.refresh(),!(L.at===null||!i.get("map"))&&(i.set("showsTime",!0),b.show(L.at))}),Object.assign(window,{dhpmap:{store:i,renderer:t,surfaces:u,slice:h}})}var gf=v0(),my=new fc(uh(location.hash).mapId,i=>{let e=gf.get("phase");e.is==="loading"&&gf.set("phase",{is:"loading",bytes:e.bytes+i})});Promise.race([my.isAsked,new Promise(i=>setTimeout(i,pA))]).then(()=>yA(gf,my));
